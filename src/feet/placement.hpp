// The places of heels and toes in contact, and the fading of corrections.
#pragma once

#include <cstdint>
#include <vector>

#include "feet/contacts.hpp"

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

}  // namespace kinemend::feet
