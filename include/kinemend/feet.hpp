// Feet on the floor: when they stand, how they slide, and how to stop them sliding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/skeleton.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The point of a foot that a contact holds. The toe is the joint at the ball of the foot, or the
/// end of a foot that has none. The heel is the joint or end site of that name, or else a point
/// fixed to the foot: level with the toe where the foot stands flat, behind the ankle by a quarter
/// of the way from ankle to toe.
enum class FootPart : std::uint8_t { heel, toe };
std::string_view to_string(FootPart part);

/// A foot of a skeleton and the joints that move it.
struct Leg {
  std::string side;  ///< "left", "right", or the ankle's name where that does not tell legs apart
  std::int32_t hip = 0;
  std::int32_t knee = 0;
  std::int32_t ankle = 0;
  std::int32_t toe = -1;  ///< joint; -1 where the foot ends at an end site, or at the ankle
};
/// The joints that are named after a foot (`foot_joints`), the knee and hip above each: the joints
/// at the upper ends of the next two bones, where joints named after a twist and those a short way
/// apart count as one bone. Errors: none; skeletons without legs have none.
std::vector<Leg> find_legs(const Skeleton& skeleton);

/// A time in which a part of a foot stands.
struct FootContact {
  std::size_t leg = 0;  ///< index into `find_legs`
  FootPart part = FootPart::heel;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  friend bool operator==(const FootContact&, const FootContact&) = default;
};

struct ContactSettings {
  /// A part is down where it is lower than `begin_height` and slower than `begin_speed`, and stays
  /// down while below the others (body heights above its level; body heights a second). Where the
  /// body goes faster than 1.2 body heights a second, as in running, speeds count by as much less.
  double begin_height = 0.015, keep_height = 0.03;
  double begin_speed = 0.15, keep_speed = 0.25;
  double least_s = 0.05;   ///< shorter contacts are none, shorter lifts are bridged
  std::optional<Axis> up;  ///< none: where the body stands above its feet
};
/// By leg, part, then frame, from the first frame after the calibration frames on. The floor may be
/// at any height. Beside the level on which a foot stands as a rule, any place is floor on which it
/// rests for 0.15 s and is the lowest foot for 0.1 s: steps and ramps. Positions are smoothed for
/// this by as much as their noise asks for. None where no direction is clearly up.
std::vector<FootContact> find_contacts(const Take& clip, const ContactSettings& settings = {});

/// Contacts as text, one a line: `left heel 12 40`, frames by `first_frame_number`; `#` starts a
/// comment. Edited by hand and read back.
std::string contacts_text(const Take& clip, const std::vector<FootContact>& contacts);
/// Sorted by leg, part, then frame. `names`: as `FeetSettings::names`. Errors:
/// `ErrorKind::unreadable_input`, `<name>:<line>: ...`, for legs, parts or frames that there are
/// not, and contacts of one part that overlap.
std::vector<FootContact> parse_contacts(std::string_view text, std::string_view name,
                                        const Take& clip, const KnownNames& names = {});

enum class FeetMode : std::uint8_t {
  off,
  automatic,  ///< contacts whose slide is an error: an intended slide is left alone
  force       ///< every contact
};

struct FeetSettings {
  FeetMode mode = FeetMode::automatic;
  ContactSettings contact;
  /// Instead of those found, and all held; frames of the whole take.
  std::optional<std::vector<FootContact>> contacts;
  KnownNames names;       ///< what joints of legs and feet are called where names do not tell
  double blend_s = 0.12;  ///< in which a correction fades out beside a contact (0.02 to 1)
  /// Share of a leg's length short of full stretch from which on the root gives way rather than the
  /// knee, which would pop (0.001 to 0.2). A leg that is straighter in the take may stay so up to a
  /// quarter of this.
  double soft_reach = 0.01;
};

/// Feet of a clip, for the report. Lengths in file units.
struct FeetFigures {
  double slide = 0;         ///< mean horizontal travel a frame of parts in contact
  double most_slide = 0;    ///< farthest that a part is from where its contact began
  double sink = 0;          ///< deepest below the level on which the part stands as a rule
  double knee_pop_deg = 0;  ///< largest second difference of a knee's angle
};

struct FeetReport {
  std::vector<std::string> sides;     ///< of the legs
  double metres_per_unit = 0;         ///< of the figures: stated or guessed; 0 where not known
  std::vector<FootContact> contacts;  ///< all
  std::vector<std::uint8_t> held;     ///< one a contact, 1 where the slide was taken out
  std::vector<std::uint8_t> still;    ///< one a contact, 1 where there was nothing to take out
  std::vector<std::string> reasons;   ///< one a contact: why it was not held; empty where held
  FeetFigures before, after;
  std::vector<std::uint8_t> changed;       ///< F x J, 1 where a rotation changed
  std::vector<std::uint8_t> root_changed;  ///< F
  std::vector<std::string> warnings;
};

/// Stops feet in contact from sliding, after Kovar, Schreiner & Gleicher 2002, "Footskate cleanup
/// for motion capture editing": place each contact, lower the root so that all feet reach with
/// knees that do not pop, solve each leg in closed form, and blend at the ends. No bone changes its
/// length. Nothing outside contacts and their blends changes, nor do calibration frames. Errors:
/// `ErrorKind::usage` for settings out of range, and contacts of legs or frames that there are not.
FeetReport clean_feet(Take& clip, const FeetSettings& settings = {});

/// The figures of a clip under given contacts. Errors: `ErrorKind::usage` as above.
FeetFigures feet_figures(const Take& clip, const std::vector<FootContact>& contacts);

/// Contacts as text, with those that were left alone as comments that say why. What stands still
/// already is listed like what was held.
std::string contacts_text(const Take& clip, const FeetReport& report);

}  // namespace kinemend
