// The scale on which `auto` compares positions with rotations: degrees for each file unit.
#pragma once

#include "kinemend/take_view.hpp"

namespace kinemend {

/// Degrees that a file unit counts as to `auto`. Positions of joints: those by which a turn moves
/// the end of a typical bone so far. Markers: 1150 a body height (a degree stands for 1.5 mm),
/// since optical systems see finer than angles are measured.
inline double degrees_per_unit(const TakeView& take) {
  // Chosen by hand (docs/methods/auto.md), not swept.
  constexpr double degrees_per_height = 1150;
  return take.markers ? degrees_per_height / take.body_height
                      : degrees_per_radian / radian_of_positions(take);
}
/// The same of a track of this space: rotations are in degrees.
inline double degrees_per_unit(const TakeView& take, Space space) {
  return space == Space::rotation ? 1 : degrees_per_unit(take);
}

}  // namespace kinemend
