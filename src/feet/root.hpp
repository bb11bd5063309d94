#pragma once

#include <vector>

#include "feet/leg_solver.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// How far the body goes down in each frame so that all held feet reach their places with a knee
/// that is no straighter than is good (F, file units, not negative): the least that is enough,
/// smoothed over time so that it is never less. Zero farther than `blend_s` from where it is
/// needed. `reaches` and `targets` are F x L. A leg that lies rather than stands asks for nothing,
/// and no frame for more than a tenth of the leg.
std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s);

}  // namespace kinemend::feet
