// The places of heels and toes in contact, the fading of corrections, and the rotations of legs in
// closed form for a target of the foot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "feet/contacts.hpp"
#include "feet/leg_motion.hpp"

namespace kinemend::feet {

/// The corrections of one heel or toe that the contacts require.
struct PartCorrection {
  std::vector<Vec3> shift;     ///< F: displacement of the part; zero far from contacts
  std::vector<double> weight;  ///< F: 1 in contacts, fading to 0 beside them
};

/// Returns one correction for each entry of `soles.points`. In a contact the part has one place:
/// its mean position, which minimises the corrections, lifted to the floor if it sinks. Places of
/// heel and toe in contact at the same time are a foot's length apart. Beside contacts a cubic that
/// starts with the shift and speed of the contact's end fades to zero within `blend_s`, or runs to
/// the next contact if that is nearer: value and velocity are continuous.
std::vector<PartCorrection> place_contacts(const Soles& soles, const LegMotion& motion,
                                           const std::vector<FootContact>& contacts,
                                           const std::vector<std::uint8_t>& held, double blend_s);

/// The target of a foot in one frame.
struct FootTarget {
  bool moves = false;    ///< the target differs from the input
  double hold = 0;       ///< 1 if a part of it is in contact, fading to 0 beside contacts
  double free_turn = 0;  ///< 1 if it may turn about its pivot, 0 if both parts are in contact
  Quat rotation;         ///< of the ankle, world
  Vec3 pivot;            ///< a point of the foot, in the ankle's frame ...
  Vec3 place;            ///< ... and its target, world
};

/// Returns the foot's target. The foot turns by the smallest rotation that brings both parts to
/// their targets; with only one part it keeps its rotation.
FootTarget foot_target(const LegPose& pose, const LegModel& model, const PartCorrection& heel,
                       const PartCorrection& toe, std::size_t frame, double least_shift);

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
