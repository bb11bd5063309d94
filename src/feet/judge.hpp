// Decides which slides are errors and which are intended.
#pragma once

#include <string>
#include <vector>

#include "feet/soles.hpp"

namespace kinemend::feet {

/// Whether the slide of each contact is an error to be removed.
struct Verdicts {
  std::vector<std::uint8_t> held;    ///< one a contact
  std::vector<std::uint8_t> still;   ///< one a contact, 1 where there is no slide
  std::vector<std::string> reasons;  ///< one a contact; empty where held
  bool jitters = false;              ///< noise, rather than drift, moves the feet of this take
};

/// `motion` is in `unit_cm` centimetres a unit of length; 0 where that is not known. Contacts of
/// one foot that touch in time are one stand and are decided together.
Verdicts judge(const Soles& soles, const LegMotion& motion,
               const std::vector<FootContact>& contacts, double unit_cm);

/// Indices of contacts, by stand.
std::vector<std::vector<std::size_t>> stands_of(const std::vector<FootContact>& contacts);

}  // namespace kinemend::feet
