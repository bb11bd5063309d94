#include <algorithm>
#include <array>
#include <limits>

#include "kinemend/kinematics.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

double skeleton_height(const Skeleton& skeleton) {
  Clip rest;
  rest.skeleton = skeleton;
  rest.root_positions.resize(1);
  rest.local_rotations.resize(skeleton.joint_count());
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
  const double height = skeleton_height(skeleton);
  for (const LengthUnit& unit : units) {
    const double metres = height * unit.metres;
    if (metres >= 1.2 && metres <= 2.5) return unit;
  }
  return std::nullopt;
}

}  // namespace kinemend
