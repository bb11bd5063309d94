// The scale on which `auto` compares positions with rotations: degrees for each file unit.
#pragma once

#include "kinemend/take_view.hpp"

namespace kinemend {

/// Degrees that `auto` takes a file unit for. Positions of joints: the turn that moves the end of a
/// typical bone by a unit. Markers: 1150 degrees per body height (1 degree is 1.5 mm), since
/// optical systems measure positions more finely than angles are measured.
inline double degrees_per_unit(const TakeView& take) {
  // Chosen by hand (docs/methods/auto.md), not swept.
  constexpr double degrees_per_height = 1150;
  return take.markers ? degrees_per_height / take.body_height
                      : degrees_per_radian / radian_of_positions(take);
}
/// The same for a track of this space: rotations are in degrees.
inline double degrees_per_unit(const TakeView& take, Space space) {
  return space == Space::rotation ? 1 : degrees_per_unit(take);
}

}  // namespace kinemend
