// One function for each check, and helpers that they share. Each adds to a report whose `tracks`
// are already named; frames count from the first frame of the given take. Joints and markers are
// rows of one view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"
#include "feet/body_points.hpp"
#include "feet/floor.hpp"
#include "kinemend/check.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend::check {

/// Returns the frames from which usual values are estimated: all of a take of so many `frames`, or
/// 200 of them, evenly spread, ascending.
std::vector<std::size_t> frames_looked_at(std::size_t frames);

/// A marker at a distance from another.
struct Neighbour {
  std::size_t marker = 0;
  double distance = 0;  ///< the median
  double spread = 0;    ///< of the distance
};
/// Returns the other markers as neighbours of marker `of`, those with the least spread first. Only
/// the given frames are compared, and only markers are returned that are seen together with `of` in
/// at least `fewest_frames` of them. The spread leaves out a share `tail` of the distances at
/// either end.
std::vector<Neighbour> neighbours_of(const Take& clip, const std::vector<std::size_t>& markers,
                                     std::size_t of, const std::vector<std::size_t>& frames,
                                     double tail, std::size_t fewest_frames);

/// Raises `largest` to a value above it; sets it if it is not known yet.
void put_largest(double value, std::optional<double>& largest);

/// Sorts findings: serious ones first, then by kind, figure, frame and track.
void sort_worst_first(std::vector<Finding>& findings);

/// The joints or markers of a take as the rows of a report.
struct Rows {
  const Take& clip;                    ///< without calibration frames, if not said otherwise
  std::vector<std::size_t> tracks;     ///< the joint or marker of each row
  std::vector<std::int32_t> row_of;    ///< the row of each joint or marker, -1: none
  std::vector<Subject> subjects = {};  ///< of markers

  /// The same rows of another version of the take.
  Rows of(const Take& other) const { return {other, tracks, row_of, subjects}; }
};

void check_gaps(const Rows& rows, CheckReport& report);
void check_noise_and_spikes(const Rows& rows, const CheckSettings& settings, CheckReport& report);
void check_stale(const Rows& rows, const CheckSettings& settings, CheckReport& report);
/// Only for markers.
void check_swaps(const Rows& rows, CheckReport& report);
void check_lengths(const Rows& rows, const CheckSettings& settings, CheckReport& report);

/// Checks the clip with its calibration frames, as its file has them.
void check_euler_flips(const Take& clip, CheckReport& report);

/// Finds frames with all values zero. Takes the clip with its calibration frames, some of which may
/// be such frames.
void check_zero_frames(const Take& clip, CheckReport& report);

/// Finds whole frames that repeat, and the rate that such repeats indicate.
void check_frames(const Rows& rows, CheckReport& report);

/// Chooses the scale, writes it into the report and checks whether the declared one fits a person.
/// In a take of markers only the largest subject is looked at.
void check_unit(const Take& clip, const CheckSettings& settings, CheckReport& report);

/// Finds feet that slide or sink, and a rate at which the body would fall too fast or too slowly.
/// Requires the scale from `check_unit`. Checks each subject separately.
void check_body(const Rows& rows, const CheckSettings& settings, CheckReport& report);

/// Checks joints against their limits of speed and acceleration. The root and the joints that carry
/// the whole body have no limits.
void check_joint_limits(const Take& clip, const RobotSettings& settings, CheckReport& report);
/// Finds rotations and positions that change within one frame and stay changed. Positions require
/// the scale from `check_unit`.
void check_jumps(const Rows& rows, const RobotSettings& settings, CheckReport& report);
/// Finds places where the root of a take of joints moves farther within one frame than a body can,
/// and stays there. Requires the scale from `check_unit`.
void check_root_jumps(const Rows& rows, CheckReport& report);
/// Finds feet in or above the floor and times in the air, for a take with `CheckSettings::robot`;
/// for joints also the height of the floor. Requires the scale from `check_unit`, and
/// `CheckReport::stands`.
void check_robot_feet(const Rows& rows, const CheckSettings& settings, CheckReport& report);

/// One flag for each step of each of N tracks, from the track's samples.
enum class Flag : std::uint8_t {
  no,
  yes,
  unknown,  ///< a sample is missing, or the track is excluded
};

struct FlagTable {
  std::size_t steps = 0;
  std::size_t tracks = 0;
  std::vector<Flag> flags;  ///< track by track

  FlagTable(std::size_t step_count, std::size_t track_count)
      : steps(step_count), tracks(track_count), flags(step_count * track_count, Flag::unknown) {}
  Flag& operator()(std::size_t step, std::size_t track) { return flags[track * steps + step]; }
  Flag operator()(std::size_t step, std::size_t track) const { return flags[track * steps + step]; }
};

/// Returns the runs of `yes`, at least `shortest` long, that chance does not explain: a run of r
/// for which p^r is below 1e-6, where p is the share of `yes` on the track outside the run, or
/// among the other tracks during the run if that is more. Runs that other tracks share (p of a half
/// or more) are not specific to one track. One list for each track.
std::vector<std::vector<FrameSpan>> improbable_runs(const FlagTable& table, std::size_t shortest);

using feet::along, feet::body_points, feet::BodyPoints, feet::find_up, feet::Foot, feet::Up;

/// The points of a body, in metres.
struct NamedBody {
  Subject subject;  ///< whose markers they are; empty for joints
  BodyPoints points;
};
/// Returns the joints as one body, or the markers of each subject; none without the scale from
/// `check_unit`.
std::vector<NamedBody> bodies_of(const Rows& rows, const CheckSettings& settings,
                                 const CheckReport& report);

/// Returns the points of a foot, smoothed over 20 ms on either side.
std::vector<feet::SolePoint> sole_points(const BodyPoints& body, const Foot& foot, Up up);

/// A span in which a foot has ground contact.
struct Contact {
  std::size_t foot = 0;
  FrameSpan span;
  double slide_m = 0;  ///< displacement of the point that moves least
  Vec3 place;          ///< median of the foot's lowest points in each frame
};

/// Finds contacts, by foot, then frame. A point touches the floor if it is slow and near its usual
/// standing height; the thresholds to begin are tighter than those to continue (hysteresis).
std::vector<Contact> find_contacts(const BodyPoints& body, Up up);

/// Returns the direction that is up: that of the settings, or else that of the body above its feet.
/// None if that is ambiguous, if the body has no feet, or if it has less than 10 frames.
std::optional<Up> up_of_body(const BodyPoints& body, const CheckSettings& settings);

/// Compares stands of markers with the loads of force plates. Loads under two feet, or under none
/// whose heel and toe are above the plate, are left out, and plates without load under a foot that
/// stands on them.
std::vector<PlateStand> plate_stands(const Take& clip, const FootStands& stands,
                                     const std::vector<ForcePlate>& plates);

/// Returns the spans in which every point of every foot is clear of the floor.
std::vector<FrameSpan> find_flights(const BodyPoints& body, Up up);

/// Returns the downward acceleration of the body in a flight, m/s^2: that of the least-squares
/// parabola through the heights of its centre.
double fall(const BodyPoints& body, Up up, const FrameSpan& span);

}  // namespace kinemend::check
