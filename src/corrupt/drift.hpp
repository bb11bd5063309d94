// The drift of heading and place in takes of inertial suits.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/experimental/random.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend::corrupt {

/// The drift of a suit that knows turns and steps but neither north nor place.
struct Drift {
  std::vector<Quat> headings;  ///< F turns about the axis that points up
  std::vector<Vec3> places;    ///< F; where the body's centre has got to
};

/// `centres` are the true centres (F). A step is taken in the direction of the heading of its time;
/// `place` drifts along the floor besides. Headings in degrees and lengths in the unit of
/// `centres`, both after a minute.
Drift drifted(const std::vector<Vec3>& centres, double rate_hz, Axis up, double heading_deg,
              double place, const Random& random);

}  // namespace kinemend::corrupt
