// Cleans the legs of a motion within given limits. Lists the steps in their order: the contacts to
// hold, the root, the knees, the figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "feet/contacts.hpp"
#include "feet/leg_motion.hpp"
#include "feet/leg_solver.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::feet {

// The length by which floors are judged, in body heights. Chosen by hand, not swept.
inline constexpr double close_to_floor = 0.012;  ///< 2 cm

/// The tracks that may change, and the error that is known to be in the take.
struct FeetLimits {
  std::vector<std::uint8_t> joints;  ///< J; empty: all
  bool root_position = true;
  bool translations = true;
  bool is_noisy = false;        ///< noise was found in the joints; it also moves standing feet
  double error = 0;             ///< of the joints, radians per axis; 0: hardly any is known
  bool has_noisy_root = false;  ///< the root's place has an error too
  bool is_slow = false;         ///< the error is slow, as of video, depth cameras and suits
};

/// Implements `clean_feet` for a clip in which every frame is motion. Frames of settings and report
/// count from the first frame of the motion.
FeetReport clean_legs(Take& motion, const FeetSettings& settings, const FeetLimits& limits = {});

/// Renumbers contacts counted from frame `from` to count from frame `to`. Throws `ErrorKind::usage`
/// for one that begins before `from`.
void shift_contacts(std::vector<FootContact>& contacts, std::size_t from, std::size_t to);

/// Whether the slide of each contact is an error to be removed.
struct Verdicts {
  std::vector<std::uint8_t> held;    ///< one for each contact
  std::vector<std::uint8_t> still;   ///< one for each contact, 1 if there is no slide
  std::vector<std::string> reasons;  ///< one for each contact; empty if held
  bool jitters = false;              ///< noise, rather than drift, moves the feet of this take
};

/// Judges each contact. `unit_cm`: centimetres in the motion's unit of length, 0 if unknown.
/// `travel_by_error`: body heights by which errors of the joints move standing feet. Contacts of
/// one foot that touch in time are one stand and are decided together.
Verdicts judge(const Soles& soles, const LegMotion& motion,
               const std::vector<FootContact>& contacts, double unit_cm, double travel_by_error);

/// Returns the indices of contacts, grouped by stand.
std::vector<std::vector<std::size_t>> stands_of(const std::vector<FootContact>& contacts);

/// Changes the variables that contacts leave free so that knees do not pop. Held feet determine
/// each knee's angle, which jumps where the take jitters, and where a leg has to straighten up to
/// the end of a contact. The free variables are the root's height (`may_lower`), the turn of a foot
/// about its single part in contact, and the distance of feet beside contacts from the hip. A few
/// Gauss-Newton steps minimise a weighted sum of squares of these changes and of the curvature of
/// each knee's angle change; parts in contact keep their places. `reaches` is F x L; `drops` is F,
/// the lowering of the root.
void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops);

/// Returns the lowering of the body in each frame so that all held feet reach their places with a
/// sufficiently bent knee (F, file units, not negative): the least sufficient, smoothed over time
/// without going below it. It is zero farther than `blend_s` from where it is needed. `reaches` and
/// `targets` are F x L. A lying leg requires no lowering, and the largest is a tenth of the leg.
std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s);

/// Returns where the part of a contact is on average.
Vec3 mean_place(const Soles& soles, const FootContact& contact);

/// Returns the usual height of each sole point above the lower one of its foot, 2 l + part.
std::vector<double> level_offsets(const Soles& soles);

/// `contacts`: in frames of the motion. `offsets`: from `level_offsets`.
FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets);

}  // namespace kinemend::feet
