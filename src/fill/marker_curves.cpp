#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

constexpr double longest_curve_s = 0.25;

// A marker's samples around a gap as a track of three channels.
struct Window {
  std::size_t first_frame = 0;
  std::vector<double> values;
  std::vector<std::uint8_t> observed;

  Track track() { return {values, 3, observed}; }
};

Window window_around(const Samples& samples, const MarkerGap& gap) {
  // As many observed samples as the longest support of a curve, other gaps between them aside.
  const std::size_t reach = 2 * samples.frames_in(0.5, 64);
  const std::size_t before = gap.starts_take ? 0 : reach, behind = gap.ends_take ? 0 : reach;
  Window window;
  window.first_frame = gap.span.first - std::min(gap.span.first, before);
  const std::size_t end = std::min(samples.frames, gap.span.last + 1 + behind);
  for (std::size_t f = window.first_frame; f < end; ++f) {
    const bool seen = samples.measures(f, gap.marker) && !gap.covers(f);
    const Vec3 p = seen ? samples.at(f, gap.marker) : Vec3{};
    window.values.insert(window.values.end(), {p.x, p.y, p.z});
    window.observed.push_back(seen ? 1 : 0);
  }
  return window;
}

std::vector<Vec3> positions_of(const Window& window, FrameSpan span) {
  std::vector<Vec3> positions;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double* p = &window.values[3 * (f - window.first_frame)];
    positions.push_back({p[0], p[1], p[2]});
  }
  return positions;
}

Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request,
                      Curve curve, std::string_view name) {
  const double length_s = static_cast<double>(gap.span.length()) / samples.frame_rate_hz;
  const double longest_s = request.longest_gap_s > 0 ? request.longest_gap_s : longest_curve_s;
  if (!request.lenient) {
    if (gap.span.first == 0 || gap.span.last + 1 == samples.frames) {
      return Filling::refused(name, "the gap is at an end of the take");
    }
    if (length_s > longest_s) {
      return Filling::refused(
          name, fmt::format("the gap of {:.2f} s is longer than {:.2f} s", length_s, longest_s));
    }
  }
  std::vector<Vec3> positions = curve_positions(samples, gap, curve);
  if (positions.empty()) return Filling::refused(name, "the marker is never seen");
  Filling filling{std::move(positions), std::string(name)};
  filling.is_evidence = false;
  return filling;
}

}  // namespace

std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve) {
  Window window = window_around(samples, gap);
  const FrameSpan inner{gap.span.first - window.first_frame, gap.span.last - window.first_frame};
  // A window that starts or ends with the gap would hide that the take goes on behind it; frames
  // of other gaps of this marker in the window are missing there too.
  if (std::find(window.observed.begin(), window.observed.end(), 1) == window.observed.end()) {
    return {};
  }
  fill_with_curve(window.track(), inner, curve, {.frame_rate_hz = samples.frame_rate_hz});
  return positions_of(window, gap.span);
}

std::vector<Vec3> meet_ends(const Samples& samples, const MarkerGap& gap, std::size_t first_frame,
                            const std::vector<Vec3>& guess) {
  Window window = window_around(samples, gap);
  const std::size_t first = std::max(first_frame, window.first_frame);
  const std::size_t end =
      std::min(first_frame + guess.size(), window.first_frame + window.observed.size());
  Guess inner{first - window.first_frame, {}};
  for (std::size_t f = first; f < end; ++f) {
    const Vec3 p = guess[f - first_frame];
    inner.values.insert(inner.values.end(), {p.x, p.y, p.z});
  }
  place_guess(window.track(),
              {gap.span.first - window.first_frame, gap.span.last - window.first_frame}, inner,
              {.frame_rate_hz = samples.frame_rate_hz});
  return positions_of(window, gap.span);
}

Filling fill_by_spline(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  return fill_by_curve(samples, gap, request, Curve::cubic, "spline");
}

Filling fill_by_quintic(const Samples& samples, const MarkerGap& gap,
                        const MarkerRequest& request) {
  return fill_by_curve(samples, gap, request, Curve::quintic, "quintic");
}

Filling fill_by_pchip(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  return fill_by_curve(samples, gap, request, Curve::shape_preserving, "pchip");
}

Filling fill_by_hermite(const Samples& samples, const MarkerGap& gap,
                        const MarkerRequest& request) {
  return fill_by_curve(samples, gap, request, Curve::hermite, "hermite");
}

}  // namespace kinemend::fill
