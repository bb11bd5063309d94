#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap,
                           const MarkerRequest& request) {
  constexpr std::string_view name = "rigid-body";
  constexpr std::size_t most_companions = 8, least_companions = 3;
  constexpr double rigid = std::numeric_limits<double>::infinity();
  const double limit = segment_spread * samples.radius;
  std::vector<Companion> segment = companions_of(samples, gap, helpers_of(samples, gap));
  const auto strangers = std::find_if(segment.begin(), segment.end(),
                                      [&](const Companion& c) { return c.spread > limit; });
  const std::size_t count = static_cast<std::size_t>(strangers - segment.begin());
  segment.resize(
      std::min(segment.size(), request.lenient ? std::max(count, least_companions) : count));
  const LocalRegression body(samples, gap, segment, most_companions);
  if (segment.size() < least_companions || !body.usable() || !body.group().turns()) {
    Filling refused = Filling::refused(
        name, fmt::format("{} other markers of its segment are seen throughout the gap; three that "
                          "are not on one line are needed",
                          count));
    refused.may_wait = true;
    return refused;
  }
  std::vector<std::size_t> frames(gap.span.length());
  std::iota(frames.begin(), frames.end(), gap.span.first);
  const LocalRegression::Scene scene = body.scene_of(gap, frames);
  const LocalRegression::Rows still = body.predict(scene, {&rigid, 1}).front();
  return {LocalRegression::meet_ends(scene, body.bridge_of(scene), still), std::string(name)};
}

}  // namespace kinemend::fill
