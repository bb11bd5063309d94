// One function for each check, and what they share. Each adds to a report whose `tracks` are named
// already; frames count from the first frame of the take it is given.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"
#include "kinemend/check.hpp"
#include "kinemend/experimental/subjects.hpp"

namespace kinemend::check {

/// Frames, evenly over the take, from which what is usual is estimated: for speed, not swept.
inline constexpr std::size_t most_looked_at = 200;

/// Serious ones first, then by kind, figure, frame and track.
void sort_worst_first(std::vector<Finding>& findings);

/// `gap_list` is of all tracks; `track_of[n]` is the row of joint or marker n in the report, -1 for
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

/// Takes the clip with its calibration frames, as its file has them.
void check_euler_flips(const Take& clip, CheckReport& report);

/// Whole frames that hold nothing but zeros. Takes the clip with its calibration frames, among
/// which some stand.
void check_zero_frames(const Take& clip, CheckReport& report);

/// Whole frames that repeat, and the rate that such repeats indicate.
void check_frames(const Take& clip, CheckReport& report);
void check_frames(const Take& clip, const std::vector<std::size_t>& markers, CheckReport& report);

/// Chooses the scale, puts it into the report and finds whether the declared one fits a person.
void check_unit(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_unit(const Take& clip, const std::vector<std::size_t>& markers,
                const CheckSettings& settings, CheckReport& report);

/// Feet that slide or sink, and a rate at which the body would fall too fast or too slowly.
/// `check_unit` comes before.
void check_body(const Take& clip, const CheckSettings& settings, CheckReport& report);
/// Each subject by itself.
void check_body(const Take& clip, const std::vector<Subject>& subjects,
                const CheckSettings& settings, CheckReport& report);

/// Joints against their limits of speed and acceleration. The root and what carries the body with
/// it have no limits.
void check_joint_limits(const Take& clip, const RobotSettings& settings, CheckReport& report);
/// Rotations and positions that change within one frame and stay changed. Those of positions need
/// the scale: `check_unit` comes before.
void check_jumps(const Take& clip, const RobotSettings& settings, CheckReport& report);
void check_jumps(const Take& clip, const std::vector<std::size_t>& markers,
                 const RobotSettings& settings, CheckReport& report);
/// Feet in or above the floor and times in the air, for a take with `CheckSettings::robot`; of
/// joints also heels and toes that stand, and the height of the floor. `check_unit` comes before.
void check_robot_feet(const Take& clip, const CheckSettings& settings, CheckReport& report);
void check_robot_feet(const Take& clip, const std::vector<Subject>& subjects,
                      const CheckSettings& settings, CheckReport& report);

}  // namespace kinemend::check
