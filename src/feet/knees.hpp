#pragma once

#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/leg_solver.hpp"
#include "feet/placement.hpp"

namespace kinemend::feet {

/// Changes what the contacts leave open so that knees do not pop. Feet that are held at their
/// places force an angle upon each knee that jumps where the take jitters, and where a leg has to
/// straighten up to the end of a contact. Open are the root's height (`may_lower`), the turn of a
/// foot about the one part it stands on, and how far feet beside contacts are from the hip. The
/// least of these, weighed against one another, that lets the change of each knee's angle pass
/// smoothly is found by a few steps of Gauss and Newton; parts in contact keep their places.
/// `reaches` is F x L, `drops` F: how far the root goes down.
void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops);

}  // namespace kinemend::feet
