// Corrects the whole body by what its standing feet tell about its errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// How sure each value of a body is, as deviations; zero: it may not change.
struct PoseUncertainty {
  double root_position = 0;        ///< file units, per axis
  double root_rotation = 0;        ///< radians, per axis
  std::vector<std::uint8_t> legs;  ///< one a leg, 1 where hip, knee and ankle may turn
  double joint_rotation = 0;       ///< radians, per axis that the joint's channels can turn about
};

/// Turns about the joints as they stand, as rotation vectors in the world, to be applied from the
/// foot upwards.
struct LegUpdate {
  Vec3 hip, knee, ankle;
};
struct PoseUpdate {
  Vec3 root_shift, root_turn;
  std::vector<LegUpdate> legs;
};

/// How wrong the joints of a take are, radians per axis, from how far its standing feet move: parts
/// in contact deviate from their places by what hips, knees and the root are off, times the length
/// of the leg. 0 where none stands. `height`: of the body.
double joint_deviation(const std::vector<PartCorrection>& parts, double height);

/// The most likely change of a body by what is known of its standing feet: the least of sum |x_j|^2
/// / s_j^2 + sum |p_i(x) - target_i|^2 / r_i^2 over turns x_j of the joints and parts i in contact,
/// by Gauss and Newton. Joints that are less sure take more, and those that a foot hangs from share
/// its error. A correction that fades beside a contact counts for less. Nothing (no legs) where no
/// part is in contact. `parts`: 2 L, heel and toe of each leg.
PoseUpdate update_by_contacts(const LegMotion& motion, std::size_t frame,
                              const std::vector<PartCorrection>& parts,
                              const PoseUncertainty& uncertainty);

}  // namespace kinemend::feet
