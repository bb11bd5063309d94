// Estimates the height of a body, and the unit that its lengths are in.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "kinemend/skeleton.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

double body_height(const Skeleton& skeleton) {
  Take rest;
  rest.skeleton = skeleton;
  rest.positions.resize(1);
  rest.rotations.resize(skeleton.joint_count());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Vec3 p : joint_positions(rest, true)) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0.0});
}

std::optional<LengthUnit> guess_length_unit(const Skeleton& skeleton) {
  // The CMU database's unit is 1 / 0.45 inch. The ranges of heights do not overlap.
  static constexpr std::array<LengthUnit, 5> units{
      {{"m", 1.0}, {"CMU unit", 0.0254 / 0.45}, {"inch", 0.0254}, {"cm", 0.01}, {"mm", 0.001}}};
  const double height = body_height(skeleton);
  for (const LengthUnit& unit : units) {
    const double metres = height * unit.metres;
    if (metres >= 1.2 && metres <= 2.5) return unit;
  }
  return std::nullopt;
}

double body_height(const Take& clip) {
  // Frames spread evenly over the take, for speed; ratio of the body height to the quartile of the
  // distances; heights of people. Chosen by hand, not swept.
  constexpr std::size_t most_frames = 64;
  constexpr double heights_per_quartile = 4.2;
  constexpr double usual_m = 1.75, tallest_m = 2.2;
  std::vector<double> distances;
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  std::vector<Vec3> seen;
  for (std::size_t i = 0; i < sampled; ++i) {
    const std::size_t f = sampled < 2 ? 0 : i * (frames - 1) / (sampled - 1);
    seen.clear();
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      if (clip.holds_positions(m) && clip.is_observed(f, m)) seen.push_back(clip.position(f, m));
    }
    for (std::size_t a = 0; a < seen.size(); ++a) {
      for (std::size_t b = a + 1; b < seen.size(); ++b)
        distances.push_back(norm(seen[a] - seen[b]));
    }
  }
  const double unit_m = metres_per_unit(clip.unit);
  const double quartile = distances.empty() ? 0 : of_rank(distances, distances.size() / 4);
  if (!(quartile > 0)) return unit_m > 0 ? usual_m / unit_m : 1.0;
  const double height = heights_per_quartile * quartile;
  return unit_m > 0 ? std::min(height, tallest_m / unit_m) : height;
}

double likely_metres_per_unit(const Take& take) {
  if (!take.has_joints()) return metres_per_unit(take.unit);
  if (take.metres_per_unit > 0) return take.metres_per_unit;
  const auto guess = guess_length_unit(take.skeleton);
  return guess ? guess->metres : 0;
}

}  // namespace kinemend
