// Lowers the body where held feet are out of reach.
#pragma once

#include <vector>

#include "feet/leg_solver.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// Lowering of the body in each frame so that all held feet reach their places with a sufficiently
/// bent knee (F, file units, not negative): the least sufficient, smoothed over time without going
/// below it. Zero farther than `blend_s` from where it is needed. `reaches` and `targets` are F x
/// L. A lying leg requires none, and the largest is a tenth of the leg.
std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s);

}  // namespace kinemend::feet
