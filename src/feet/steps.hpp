// The steps of cleaning legs, in their order: which contacts count, the root, the knees, the
// figures.
#pragma once

#include <string>
#include <vector>

#include "feet/leg_motion.hpp"
#include "feet/leg_solver.hpp"
#include "feet/placement.hpp"
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

/// Changes the variables that contacts leave free so that knees do not pop. Held feet determine
/// each knee's angle, which jumps where the take jitters, and where a leg has to straighten up to
/// the end of a contact. Free are the root's height (`may_lower`), the turn of a foot about the one
/// part it stands on, and how far feet beside contacts are from the hip. A weighted sum of squares
/// of these changes and of the curvature of each knee's angle change is minimised by a few
/// Gauss-Newton steps; parts in contact keep their places. `reaches` is F x L, `drops` F: how far
/// the root goes down.
void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops);

/// Lowering of the body in each frame so that all held feet reach their places with a sufficiently
/// bent knee (F, file units, not negative): the least sufficient, smoothed over time without going
/// below it. Zero farther than `blend_s` from where it is needed. `reaches` and `targets` are F x
/// L. A lying leg requires none, and the largest is a tenth of the leg.
std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s);

/// Usual height of each sole point above the lower one of its foot, 2 l + part.
std::vector<double> level_offsets(const Soles& soles);

/// `contacts` in frames of the motion; `offsets` as above.
FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets);

}  // namespace kinemend::feet
