// Solves the rotations of a leg in closed form for a target of its foot.
#pragma once

#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// Returns the unit vector of an axis.
Vec3 axis_vector(Axis axis);

/// Returns the nearest rotation that the channels of a joint allow.
Quat within_channels(Quat rotation, const LegJoint& joint);

/// Returns the rotation vector of the smallest turn from the direction of `from` to that of `to`.
Vec3 turn_between(Vec3 from, Vec3 to);

/// Returns the same turn as a rotation.
Quat least_turn(Vec3 from, Vec3 to);

/// The distances from hip to ankle that a leg can reach.
struct Reach {
  double now = 0;   ///< in the input pose
  double easy = 0;  ///< at the largest extension of the knee that avoids popping
  double most = 0;  ///< with the knee straight
};
/// Returns the reach of a leg. `easy` is below `most` by the share `soft_reach`, or equal to `now`
/// if that is larger. A nearly straight knee turns by degrees per millimetre, so a held leg (`hold`
/// 1; 0 for a free one) stays below `most` by a quarter of the share even then.
Reach reach_of(const LegPose& pose, const LegModel& model, double soft_reach, double hold);

/// Returns F x L reaches, with `hold` taken from the targets.
std::vector<Reach> reaches_of(const LegMotion& motion, const std::vector<FootTarget>& targets,
                              double soft_reach);

/// Returns `distance`, or beyond `reach.easy` a distance that smoothly approaches `reach.most`: e +
/// (m - e) (1 - exp(-(d - e) / (m - e))).
double soft_distance(double distance, const Reach& reach);

/// Local rotations of a leg.
struct LegRotations {
  Quat hip, knee, ankle;
};

/// Solves a leg in closed form: the knee bends about its hinge until the ankle is as far from the
/// hip as its target, the hip moves the leg there by the smallest turn, and the ankle gives the
/// foot its rotation. If a joint has fewer than three rotation channels, the others compensate for
/// it in a few iterations. `hip_shift`: displacement of the hip.
LegRotations solve_leg(const LegPose& pose, const LegModel& model, const FootTarget& target,
                       Vec3 hip_shift, double soft_reach);

}  // namespace kinemend::feet
