// Where heels and toes belong while they are in contact, and how corrections fade.
#pragma once

#include <cstdint>
#include <vector>

#include "feet/soles.hpp"

namespace kinemend::feet {

/// The corrections of one heel or toe that the contacts require.
struct PartCorrection {
  std::vector<Vec3> shift;     ///< F: displacement of the part; zero far from contacts
  std::vector<double> weight;  ///< F: 1 in contacts, fading to 0 beside them
};

/// One an entry of `soles.points`. In a contact the part has one place: its mean position, which
/// minimises the corrections, lifted to the floor where it sinks. Places of a heel and a toe in
/// contact at once are a foot's length apart. Beside contacts a cubic with the shift and the speed
/// that the contact ends with fades to nothing within `blend_s`, or runs to the next contact where
/// that is nearer: value and velocity are continuous.
std::vector<PartCorrection> place_contacts(const Soles& soles, const LegMotion& motion,
                                           const std::vector<FootContact>& contacts,
                                           const std::vector<std::uint8_t>& held, double blend_s);

/// The target of a foot in one frame.
struct FootTarget {
  bool moves = false;    ///< the target differs from the input
  double hold = 0;       ///< 1 where a part of it is in contact, fading to 0 beside contacts
  double free_turn = 0;  ///< 1 where it may turn about its pivot, 0 where both parts are down
  Quat rotation;         ///< of the ankle, world
  Vec3 pivot;            ///< a point of the foot, in the ankle's frame ...
  Vec3 place;            ///< ... and its target, world
};

/// The foot turns by the least rotation that brings both parts to their targets; with one part
/// alone it keeps its rotation.
FootTarget foot_target(const LegPose& pose, const LegModel& model, const PartCorrection& heel,
                       const PartCorrection& toe, std::size_t frame, double least_shift);

}  // namespace kinemend::feet
