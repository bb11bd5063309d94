// Feet on the floor: when they stand, how they slide, and how to stop them sliding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// The point of a foot that a contact holds. The toe is the joint at the ball of the foot, or the
/// end of a foot without that joint. The heel is the joint or end site of that name, or else a
/// point fixed to the foot: level with the toe when the foot is flat, and behind the ankle by a
/// quarter of the distance from ankle to toe.
enum class FootPart : std::uint8_t { heel, toe };
std::string_view to_string(FootPart part);

/// A foot of a skeleton and the joints that move it.
struct Leg {
  std::string side;  ///< "left", "right", or the ankle's name if sides do not distinguish the legs
  std::int32_t hip = 0;
  std::int32_t knee = 0;
  std::int32_t ankle = 0;
  std::int32_t toe = -1;  ///< joint; -1 if the foot ends at an end site, or at the ankle
};
/// Returns the joints that are named after a foot (`foot_joints`) with the knee and hip above each:
/// the joints at the upper ends of the next two bones. Joints named after a twist and joints that
/// are a short distance apart belong to one bone. Empty for skeletons without legs. Throws no
/// errors.
std::vector<Leg> find_legs(const Skeleton& skeleton);

/// A span of frames in which a part of a foot stands on the floor.
struct FootContact {
  std::size_t leg = 0;  ///< index into `find_legs`
  FootPart part = FootPart::heel;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  double confidence = 1;       ///< how likely it is (0..1); 1 for contacts that were given
  /// The same part and frames, whatever the confidence.
  friend bool operator==(const FootContact& a, const FootContact& b) {
    return a.leg == b.leg && a.part == b.part && a.first_frame == b.first_frame &&
           a.last_frame == b.last_frame;
  }
};

/// How contacts are found.
enum class ContactFinder : std::uint8_t {
  /// A network on the motion of the whole body. Where no model ships, and below 12 Hz, as
  /// `thresholds`.
  model,
  thresholds  ///< heights and speeds of heels and toes, which suffices for clean takes
};

struct ContactSettings {
  ContactFinder finder = ContactFinder::model;
  /// A part comes down when it is lower than `begin_height` and slower than `begin_speed`, and
  /// stays down while below `keep_height` and `keep_speed` (body heights above its level; body
  /// heights per second). When the body moves faster than 1.2 body heights per second, as in
  /// running, speeds are divided by the body's speed over that limit.
  double begin_height = 0.015, keep_height = 0.03;
  double begin_speed = 0.15, keep_speed = 0.25;
  /// Minimum duration; shorter contacts are discarded, shorter lifts are bridged.
  double least_s = 0.05;
  std::optional<Axis> up;  ///< empty: the direction in which the body is above its feet
};
/// Finds contacts after the calibration frames, sorted by leg, part, then frame. The floor may be
/// at any height. Besides the level on which a foot usually stands, any place on which it rests for
/// 0.15 s while it is the lowest foot for 0.1 s is floor: steps and ramps. Positions are smoothed
/// according to their noise first. Empty if no direction is clearly up.
std::vector<FootContact> find_contacts(const Take& clip, const ContactSettings& settings = {});

/// Returns contacts as text, one per line: `left heel 12 40`, with frames numbered from
/// `first_frame_number`; `#` starts a comment. The text may be edited by hand and read back.
std::string contacts_text(const Take& clip, const std::vector<FootContact>& contacts);
/// Reads contacts and sorts them by leg, part, then frame. `names`: as `FeetSettings::names`.
/// Errors: `ErrorKind::unreadable_input`, `<name>:<line>: ...`, for legs, parts or frames that do
/// not exist, and for contacts of one part that overlap.
std::vector<FootContact> parse_contacts(std::string_view text, std::string_view name,
                                        const Take& clip, const KnownNames& names = {});

enum class FeetMode : std::uint8_t {
  off,
  /// In `clean_take`: automatic in takes of joints of a source with slow errors
  /// (`expects_slow_noise`), else off. Elsewhere: automatic.
  by_source,
  automatic,  ///< contacts whose slide is an error; an intentional slide is kept
  force       ///< every contact
};

struct FeetSettings {
  FeetMode mode = FeetMode::automatic;
  ContactSettings contact;
  /// Contacts to use instead of those found, in frames of the whole take; all are held.
  std::optional<std::vector<FootContact>> contacts;
  KnownNames names;       ///< names of the joints of legs and feet, if they are not recognised
  double blend_s = 0.12;  ///< time in which a correction fades out beside a contact (0.02 to 1)
  /// Distance from full stretch, as a share of the leg's length, below which the root moves instead
  /// of the knee, because the knee would pop (0.001 to 0.2). A leg that is straighter in the take
  /// may stay straighter, up to a quarter of this.
  double soft_reach = 0.01;
};

/// Figures of the feet of a clip, for the report. Lengths are in file units.
struct FeetFigures {
  double slide = 0;         ///< mean horizontal travel per frame of parts in contact
  double most_slide = 0;    ///< largest distance of a part from the place where its contact began
  double sink = 0;          ///< largest depth below the level on which the part usually stands
  double knee_pop_deg = 0;  ///< largest second difference of a knee's angle
};

/// Times in which feet stand, summed over feet, seconds, and how they move then.
struct StandingTime {
  /// The sum of the likelihoods that a foot stands on its heel or toe; without a model, the time
  /// found.
  double expected_s = 0;
  double found_s = 0;     ///< in contacts
  double held_s = 0;      ///< in contacts whose slide was removed
  double still_s = 0;     ///< in contacts that had no slide to remove
  double confidence = 0;  ///< mean over the time found (0..1)
};

/// The time in which a foot carries load, as a force plate sees it, from when it comes down to when
/// it lifts off. A part of a foot stands, that is does not move, for a part of this time.
struct GroundTime {
  std::size_t leg = 0;
  std::size_t first_frame = 0, last_frame = 0;  ///< in which heel or toe stand; inclusive
  /// From the first frame of the take. Empty if the foot stands in the first or the last frame.
  std::optional<double> touch_down_s, lift_off_s;
};

/// The feet of a take and the times in which they stand.
struct FootStands {
  std::vector<std::string> sides;  ///< "left", "right"; "Ann left" in a take of several people
  /// By foot and `FootPart`: the joint or marker that shows the part; the ankle shows the heel.
  std::vector<std::array<std::size_t, 2>> tracks;
  /// Sorted by foot, part, then frame; `leg` is an index into `sides`.
  std::vector<FootContact> contacts;
  std::vector<GroundTime> ground;  ///< by foot, then time; `leg` as in contacts
  StandingTime time;               ///< nothing is held
};
/// Finds the feet of a take of joints or markers and their contacts, those of joints as
/// `find_contacts` does. A foot of markers has one on the heel and one on the toe or the ball of
/// the foot, of a marker set in use: LHEE and LTOE, R_FCC and R_FM1, "l heel" and "l met". `names`:
/// of joints or markers, if they are not recognised. `metres_per_unit`: of markers; 0: as the take
/// states, else the unit that gives the body the size of a person. No feet are found without such
/// a unit, and if no direction is clearly up.
FootStands find_stands(const Take& take, const ContactSettings& settings = {},
                       const KnownNames& names = {}, double metres_per_unit = 0);

struct FeetReport {
  std::vector<std::string> sides;  ///< sides of the legs
  double frame_rate_hz = 0;
  StandingTime time;
  double metres_per_unit = 0;         ///< scale of the figures, stated or guessed; 0 if unknown
  std::vector<FootContact> contacts;  ///< all
  std::vector<std::uint8_t> held;     ///< one per contact, 1 if the slide was removed
  std::vector<std::uint8_t> still;    ///< one per contact, 1 if there was no slide to remove
  std::vector<std::string> reasons;   ///< one per contact: why it was not held; empty if held
  FeetFigures before, after;
  std::vector<std::uint8_t> changed;       ///< F x J, 1 if a rotation changed
  std::vector<std::uint8_t> root_changed;  ///< F
  std::vector<std::string> warnings;
};

/// Stops feet in contact from sliding, after Kovar, Schreiner & Gleicher 2002, "Footskate cleanup
/// for motion capture editing": place each contact, lower the root so that all feet reach with
/// knees that do not pop, solve each leg in closed form, and blend at the ends. No bone changes its
/// length. Nothing outside contacts and their blends changes, nor do calibration frames. Errors:
/// `ErrorKind::usage` for settings out of range, and contacts of legs or frames that do not exist.
FeetReport clean_feet(Take& clip, const FeetSettings& settings = {});

/// Returns the figures of a clip for given contacts. Errors: `ErrorKind::usage` as above.
FeetFigures feet_figures(const Take& clip, const std::vector<FootContact>& contacts);

/// Returns, for each leg, the frames in which it stands on its heel or toe: 1 or 0, F numbers.
std::vector<std::vector<double>> contact_curves(const FeetReport& report, std::size_t frames);
/// Returns the name of a leg's curve: contact_l, contact_r, or contact_ and the leg's side.
std::string contact_curve_name(std::string_view side);

/// Returns contacts as text; contacts that were not held are comments with the reason. Contacts
/// without slide are listed like those that were held.
std::string contacts_text(const Take& clip, const FeetReport& report);

}  // namespace kinemend
