// One function for each check, and helpers that they share. Each adds to a report whose `tracks`
// are already named; frames count from the first frame of the given take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"
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

/// `gap_list`: of all tracks. `track_of[n]`: the row of joint or marker n in the report, -1 for
/// none.
void check_gaps(const std::vector<Gap>& gap_list, const std::vector<std::int32_t>& track_of,
                CheckReport& report);

void check_noise_and_spikes(const Take& clip, const CheckSettings& settings, CheckReport& report);
/// `markers`: the marker of each track of the report.
void check_noise_and_spikes(const Take& clip, const std::vector<std::size_t>& markers,
                            const CheckSettings& settings, CheckReport& report);

void check_stale(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_stale(const Take& clip, const std::vector<std::size_t>& markers,
                 const CheckSettings& settings, CheckReport& report);

void check_swaps(const Take& clip, const std::vector<std::int32_t>& track_of, CheckReport& report);

void check_lengths(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_lengths(const Take& clip, const std::vector<std::size_t>& markers,
                   const CheckSettings& settings, CheckReport& report);

/// Checks the clip with its calibration frames, as its file has them.
void check_euler_flips(const Take& clip, CheckReport& report);

/// Finds frames with all values zero. Takes the clip with its calibration frames, some of which may
/// be such frames.
void check_zero_frames(const Take& clip, CheckReport& report);

/// Finds whole frames that repeat, and the rate that such repeats indicate.
void check_frames(const Take& clip, CheckReport& report);
void check_frames(const Take& clip, const std::vector<std::size_t>& markers, CheckReport& report);

/// Chooses the scale, writes it into the report and checks whether the declared one fits a person.
void check_unit(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_unit(const Take& clip, const std::vector<std::size_t>& markers,
                const CheckSettings& settings, CheckReport& report);

/// Finds feet that slide or sink, and a rate at which the body would fall too fast or too slowly.
/// Requires the scale from `check_unit`.
void check_body(const Take& clip, const CheckSettings& settings, CheckReport& report);
/// Checks each subject separately.
void check_body(const Take& clip, const std::vector<Subject>& subjects,
                const CheckSettings& settings, CheckReport& report);

/// Checks joints against their limits of speed and acceleration. The root and the joints that carry
/// the whole body have no limits.
void check_joint_limits(const Take& clip, const RobotSettings& settings, CheckReport& report);
/// Finds rotations and positions that change within one frame and stay changed. Positions require
/// the scale from `check_unit`.
void check_jumps(const Take& clip, const RobotSettings& settings, CheckReport& report);
void check_jumps(const Take& clip, const std::vector<std::size_t>& markers,
                 const RobotSettings& settings, CheckReport& report);
/// Finds feet in or above the floor and times in the air, for a take with `CheckSettings::robot`;
/// for joints also contacts of heels and toes, and the height of the floor. Requires the scale from
/// `check_unit`.
void check_robot_feet(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_robot_feet(const Take& clip, const std::vector<Subject>& subjects,
                      const CheckSettings& settings, CheckReport& report);

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

}  // namespace kinemend::check
