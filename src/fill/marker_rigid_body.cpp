#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

// Markers of one segment keep their distances to this share of the body's radius.
constexpr double largest_spread = 0.02;

}  // namespace

Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap,
                           const MarkerRequest& request) {
  constexpr std::string_view name = "rigid-body";
  const double limit = largest_spread * body_radius(samples);
  std::vector<std::size_t> segment;
  for (const Companion& companion : companions_of(samples, gap, helpers_of(samples, gap))) {
    if (companion.spread <= limit || (request.lenient && segment.size() < 3)) {
      segment.push_back(companion.marker);
    }
  }
  const LocalRegression body(samples, gap, segment);
  if (segment.size() < 3 || !body.usable() || !body.group().turns()) {
    Filling refused = Filling::refused(
        name, fmt::format("{} other markers of its segment are seen throughout the gap, and three "
                          "that are not on one line are needed",
                          segment.size()));
    refused.may_wait = true;
    return refused;
  }
  std::vector<std::size_t> frames(gap.span.length());
  std::iota(frames.begin(), frames.end(), gap.span.first);
  constexpr std::array stiffness = {std::numeric_limits<double>::infinity()};
  return {body.predict(gap.span, frames, stiffness).front(), std::string(name), {}, 0, false};
}

}  // namespace kinemend::fill
