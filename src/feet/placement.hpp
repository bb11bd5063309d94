#pragma once

#include <cstdint>
#include <vector>

#include "feet/soles.hpp"

namespace kinemend::feet {

/// What the contacts ask of one heel or toe.
struct PartCorrection {
  std::vector<Vec3> shift;     ///< F: where the part goes from where it is; zero far from contacts
  std::vector<double> weight;  ///< F: 1 in contacts, fading to 0 beside them
};

/// One an entry of `soles.points`. In a contact the part stands at one place: the mean of where it
/// was, so that the corrections are least, lifted to the floor where it sinks. Places of a heel and
/// a toe that stand at once are as far apart as the foot is long. Beside contacts a cubic with the
/// shift and the speed that the contact ends with fades to nothing within `blend_s`, or runs to the
/// next contact where that is nearer: value and velocity are continuous.
std::vector<PartCorrection> place_contacts(const Soles& soles, const LegMotion& motion,
                                           const std::vector<FootContact>& contacts,
                                           const std::vector<std::uint8_t>& held, double blend_s);

/// Where a foot shall be in one frame.
struct FootTarget {
  bool moves = false;    ///< it goes elsewhere than it is
  double hold = 0;       ///< 1 where a part of it is in contact, fading to 0 beside contacts
  double free_turn = 0;  ///< 1 where it may turn about its pivot, 0 where both parts are down
  Quat rotation;         ///< of the ankle, world
  Vec3 pivot;            ///< a point of the foot, in the ankle's frame ...
  Vec3 place;            ///< ... and where it shall be, world
};

/// The foot turns as little as it can to bring both parts where they shall be; with one part alone
/// it keeps its rotation.
FootTarget foot_target(const LegPose& pose, const LegModel& model, const PartCorrection& heel,
                       const PartCorrection& toe, std::size_t frame, double least_shift);

}  // namespace kinemend::feet
