// The times in which feet carry load, from those in which their parts stand.
#pragma once

#include <vector>

#include "feet/contacts.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::feet {

/// Returns when each foot comes down and lifts off, by leg, then time. `contacts`: of the soles, in
/// their frames, sorted by leg and part.
std::vector<GroundTime> ground_times(const Soles& soles, const std::vector<FootContact>& contacts);

}  // namespace kinemend::feet
