// Solves the rotations of a leg in closed form for a target of its foot.
#pragma once

#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// Of length 1.
Vec3 axis_vector(Axis axis);

/// The nearest rotation that the channels of a joint allow.
Quat within_channels(Quat rotation, const LegJoint& joint);

/// The rotation vector of the least turn that brings the direction of `from` to that of `to`.
Vec3 turn_between(Vec3 from, Vec3 to);

/// The same as a rotation.
Quat least_turn(Vec3 from, Vec3 to);

/// Distances from hip to ankle that a leg reaches.
struct Reach {
  double now = 0;   ///< as it is
  double easy = 0;  ///< at the largest extension of the knee that avoids popping
  double most = 0;  ///< with the knee straight
};
/// Easy is short of `most` by the share `soft_reach`, or what the leg reaches as it is where that
/// is farther. A nearly straight knee turns by degrees per millimetre, so that a held leg (`hold`
/// 1; 0 for a free one) stays short by a quarter of the share even then.
Reach reach_of(const LegPose& pose, const LegModel& model, double soft_reach, double hold);

/// F x L, as the targets hold them.
std::vector<Reach> reaches_of(const LegMotion& motion, const std::vector<FootTarget>& targets,
                              double soft_reach);

/// `distance`, or where that is beyond `reach.easy` a distance that nears `reach.most` smoothly:
/// e + (m - e) (1 - exp(-(d - e) / (m - e))).
double soft_distance(double distance, const Reach& reach);

/// Local rotations of a leg.
struct LegRotations {
  Quat hip, knee, ankle;
};

/// Closed form: the knee bends about its hinge until the ankle is as far from the hip as its
/// target is, the hip takes the leg there by the least turn, the ankle gives the foot its rotation.
/// Where a joint has fewer than three rotation channels the others compensate for it in a few
/// iterations. `hip_shift` is how far the hip itself moves.
LegRotations solve_leg(const LegPose& pose, const LegModel& model, const FootTarget& target,
                       Vec3 hip_shift, double soft_reach);

}  // namespace kinemend::feet
