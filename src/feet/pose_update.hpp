// Corrects the whole body by its standing feet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// The uncertainty of each value of a body as a standard deviation; zero: it may not change.
struct PoseUncertainty {
  double root_position = 0;        ///< file units, per axis
  double root_rotation = 0;        ///< radians, per axis
  std::vector<std::uint8_t> legs;  ///< one for each leg, 1 if hip, knee and ankle may turn
  double joint_rotation = 0;       ///< radians, per axis that the joint's channels can turn about
};

/// Turns about the joints in their current pose, as rotation vectors in the world, to be applied
/// from the foot upwards.
struct LegUpdate {
  Vec3 hip, knee, ankle;
};
struct PoseUpdate {
  Vec3 root_shift, root_turn;
  std::vector<LegUpdate> legs;
};

/// Returns the error of a take's joints, radians per axis, from the movement of its standing feet:
/// parts in contact deviate from their places by the errors of hips, knees and the root, times the
/// length of the leg. Returns 0 without contacts. `height`: of the body.
double joint_deviation(const std::vector<PartCorrection>& parts, double height);

/// Returns the most likely change of a body given its standing feet: the minimum of sum |x_j|^2 /
/// s_j^2 + sum |p_i(x) - target_i|^2 / r_i^2 over turns x_j of the joints and parts i in contact,
/// by Gauss and Newton. Less certain joints take more, and all joints above a foot share its error.
/// A correction that fades beside a contact weighs less. Returns no legs if no part is in contact.
/// `parts`: 2 L, heel and toe of each leg.
PoseUpdate update_by_contacts(const LegMotion& motion, std::size_t frame,
                              const std::vector<PartCorrection>& parts,
                              const PoseUncertainty& uncertainty);

}  // namespace kinemend::feet
