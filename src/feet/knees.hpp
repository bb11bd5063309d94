// Changes what contacts leave free so that knees do not pop.
#pragma once

#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/leg_solver.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// Changes the variables that contacts leave free so that knees do not pop. Held feet determine
/// each knee's angle, which jumps where the take jitters, and where a leg has to straighten up to
/// the end of a contact. Free are the root's height (`may_lower`), the turn of a foot about the one
/// part it stands on, and how far feet beside contacts are from the hip. A weighted sum of squares
/// of these changes and of the curvature of each knee's angle change is minimised by a few
/// Gauss-Newton steps; parts in contact keep their places. `reaches` is F x L, `drops` F: how far
/// the root goes down.
void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops);

}  // namespace kinemend::feet
