#pragma once

#include <vector>

#include "feet/soles.hpp"

namespace kinemend::feet {

/// How far each sole point stands above its foot's lower one as a rule, 2 l + part.
std::vector<double> level_offsets(const Soles& soles);

/// `contacts` in frames of the motion; `offsets` as above.
FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets);

}  // namespace kinemend::feet
