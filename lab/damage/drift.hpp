// The drift of heading and place in takes of inertial suits.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::corrupt {

/// The drift of a suit that measures turns and steps but neither north nor place.
struct Drift {
  std::vector<Quat> headings;  ///< F turns about the up axis
  std::vector<Vec3> places;    ///< F; drifted places of the body's centre
};

/// Returns the drift of `centres`, the true centres (F). Each step is taken in the direction of the
/// drifted heading at its time; `place` adds a drift along the floor. `heading_deg` (degrees) and
/// `place` (the unit of `centres`) are the standard deviations after a minute.
Drift drifted(const std::vector<Vec3>& centres, double rate_hz, Axis up, double heading_deg,
              double place, const Random& random);

}  // namespace kinemend::corrupt
