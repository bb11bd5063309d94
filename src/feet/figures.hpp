// Figures of the feet in a motion, for the report.
#pragma once

#include <vector>

#include "feet/soles.hpp"

namespace kinemend::feet {

/// Usual height of each sole point above the lower one of its foot, 2 l + part.
std::vector<double> level_offsets(const Soles& soles);

/// `contacts` in frames of the motion; `offsets` as above.
FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets);

}  // namespace kinemend::feet
