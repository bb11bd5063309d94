#include "io/marker_zeros.hpp"

#include <algorithm>

namespace kinemend {

namespace {

constexpr double near_origin_m = 0.05;
constexpr double metres_of_unknown_unit = 0.001;

}  // namespace

MissingZeros mark_zeros_missing(MarkerClip& clip) {
  const double unit_m = metres_per_unit(clip.unit);
  const double near_origin = near_origin_m / (unit_m > 0 ? unit_m : metres_of_unknown_unit);
  const std::size_t frames = clip.frame_count(), markers = clip.marker_count();
  MissingZeros found{0, frames};
  const auto is_zero = [&](std::size_t f, std::size_t m) {
    return clip.is_observed(f, m) && clip.position(f, m) == Vec3{};
  };
  const auto is_near = [&](std::size_t f, std::size_t m) {
    return clip.is_observed(f, m) && norm(clip.position(f, m)) < near_origin;
  };
  if (std::find(clip.positions.begin(), clip.positions.end(), Vec3{}) == clip.positions.end()) {
    return found;
  }
  for (std::size_t m = 0; m < markers; ++m) {
    for (std::size_t f = 0; f < frames; ++f) {
      if (!is_zero(f, m)) continue;
      const std::size_t first = f;
      while (f < frames && is_zero(f, m)) ++f;
      const bool really_there =
          (first > 0 && is_near(first - 1, m)) || (f < frames && is_near(f, m));
      if (really_there) continue;
      for (std::size_t i = first; i < f; ++i) clip.observed[i * markers + m] = 0;
      found.samples += f - first;
      found.first_frame = std::min(found.first_frame, first);
    }
  }
  return found;
}

}  // namespace kinemend
