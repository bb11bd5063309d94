// Finds joints that exceed their limits, and values that jump within one frame.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "check/checks.hpp"
#include "check/runs.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/experimental/wildcards.hpp"

namespace kinemend::check {

namespace {

// The joints from the root to the first with several children carry the whole body, so no motor
// turns them.
std::vector<std::uint8_t> motor_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> children(skeleton.joint_count());
  for (const std::int32_t parent : skeleton.parents) {
    if (parent >= 0) ++children[static_cast<std::size_t>(parent)];
  }
  std::vector<std::uint8_t> has_motor(skeleton.joint_count(), 1);
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const std::int32_t parent = skeleton.parents[j];
    const bool is_carried = parent >= 0 && (has_motor[static_cast<std::size_t>(parent)] != 0 ||
                                            children[static_cast<std::size_t>(parent)] > 1);
    has_motor[j] = is_carried ? 1 : 0;
  }
  return has_motor;
}

JointLimits limits_of(const std::string& name, const RobotSettings& settings) {
  JointLimits limits = settings.limits;
  for (const NamedJointLimits& entry : settings.joints) {
    if (matches_wildcards(entry.pattern, name)) limits = entry.limits;
  }
  return limits;
}

// Speed and acceleration of a joint by frame, in degrees and seconds; 0 if unknown.
struct JointRates {
  std::vector<double> speeds, accelerations;
};

JointRates rates_of(const Take& clip, std::size_t joint, std::size_t step) {
  const std::size_t frames = clip.frame_count();
  const double seconds = static_cast<double>(step) / clip.frame_rate_hz;
  JointRates rates{std::vector<double>(frames), std::vector<double>(frames)};
  const auto turn_from = [&](std::size_t f) {
    return log(conjugate(clip.rotation(f, joint)) * clip.rotation(f + step, joint));
  };
  const auto is_seen = [&](std::size_t f) { return clip.is_observed(f, joint); };
  for (std::size_t f = 0; f + step < frames; ++f) {
    if (!is_seen(f) || !is_seen(f + step)) continue;
    const Vec3 turn = turn_from(f);
    rates.speeds[f] = degrees_per_radian * norm(turn) / seconds;
    if (f < step || !is_seen(f - step)) continue;
    rates.accelerations[f] =
        degrees_per_radian * norm(turn - turn_from(f - step)) / (seconds * seconds);
  }
  return rates;
}

// Returns runs of frames above a limit; a short time below it does not end a run.
std::vector<FrameSpan> spans_above(const std::vector<double>& values, double limit,
                                   double frame_rate_hz) {
  constexpr double bridged_s = 0.1;
  const std::size_t bridged = frames_in(bridged_s, frame_rate_hz, 1);
  std::vector<FrameSpan> spans;
  for (const FrameSpan& run :
       runs_where(values.size(), [&](std::size_t f) { return values[f] > limit; })) {
    if (!spans.empty() && run.first <= spans.back().last + bridged)
      spans.back().last = run.last;
    else
      spans.push_back(run);
  }
  return spans;
}

double largest_in(const std::vector<double>& values, const FrameSpan& span) {
  return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(span.first),
                           values.begin() + static_cast<std::ptrdiff_t>(span.last + 1));
}

void report_rates(const std::string& name, const JointRates& rates, const JointLimits& limits,
                  std::size_t step, CheckReport& report) {
  const auto report_above = [&](FindingKind kind, const std::vector<double>& values, double limit,
                                const char* verb, const char* unit) {
    for (const FrameSpan& span : spans_above(values, limit, report.frame_rate_hz)) {
      report.findings.push_back({kind, Severity::warning, name, span.first, span.last + step,
                                 largest_in(values, span), unit,
                                 fmt::format("{} its limit of {} {}", verb, figure(limit), unit)});
    }
  };
  report_above(FindingKind::joint_speed, rates.speeds, limits.speed_deg_s, "turns faster than",
               "deg/s");
  report_above(FindingKind::joint_acceleration, rates.accelerations, limits.acceleration_deg_s2,
               "accelerates more than", "deg/s2");
}

// Returns the distance between the two sides of the step from f to f + 1 if each continues for half
// the step with its own velocity.
double miss(Quat before, Quat from, Quat to, Quat after) {
  const Quat left = from * exp(0.5 * log(conjugate(before) * from));
  const Quat right = to * exp(-0.5 * log(conjugate(to) * after));
  return degrees_per_radian * angle_between(left, right);
}
double miss(Vec3 before, Vec3 from, Vec3 to, Vec3 after) {
  return norm(from + 0.5 * (from - before) - (to - 0.5 * (after - to)));
}

// Returns the steps whose sides miss each other by more than `limit` while the steps beside them
// miss less. After a jump that stays these miss half as much; beside a single wrong sample, a
// spike, they miss as much. In a jittery track, which misses often, only steps far above the usual
// are jumps.
template <class Value, class Seen>
std::vector<std::pair<std::size_t, double>> jumps_of(std::size_t frames, double limit,
                                                     const Value& value, const Seen& seen) {
  constexpr double most_beside = 0.75, usual_share = 0.9, times_usual = 6;
  std::vector<double> misses(frames);
  for (std::size_t f = 1; f + 2 < frames; ++f) {
    if (seen(f - 1) && seen(f) && seen(f + 1) && seen(f + 2))
      misses[f] = miss(value(f - 1), value(f), value(f + 1), value(f + 2));
  }
  std::vector<double> sorted = misses;
  const double least = std::max(limit, times_usual * quantile_of(sorted, usual_share));
  std::vector<std::pair<std::size_t, double>> jumps;
  for (std::size_t f = 1; f + 2 < frames; ++f) {
    const double beside = std::max(misses[f - 1], misses[f + 1]);
    if (misses[f] > least && beside < most_beside * misses[f]) jumps.emplace_back(f, misses[f]);
  }
  return jumps;
}

// At low rates the motion itself changes more within a frame.
double at_rate(double limit, double frame_rate_hz) {
  constexpr double usual_rate_hz = 60;
  return limit * std::max(1.0, usual_rate_hz / frame_rate_hz);
}

void report_jumps(const std::string& track, const char* unit, const char* words,
                  const std::vector<std::pair<std::size_t, double>>& jumps, CheckReport& report) {
  for (const auto& [frame, amount] : jumps) {
    report.findings.push_back(
        {FindingKind::jump, Severity::serious, track, frame, frame + 1, amount, unit, words});
  }
  report.figures.jumps = report.figures.jumps.value_or(0) + jumps.size();
}

}  // namespace

void check_joint_limits(const Take& clip, const RobotSettings& settings, CheckReport& report) {
  const std::size_t step = frames_in(settings.step_s, clip.frame_rate_hz, 1);
  const std::vector<std::uint8_t> has_motor = motor_joints(clip.skeleton);
  double speed = 0, acceleration = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (has_motor[j] == 0) continue;
    const JointRates rates = rates_of(clip, j, step);
    TrackHealth& track = report.tracks[j];
    const FrameSpan all{0, clip.frame_count() - 1};
    track.peak_speed_deg_s = largest_in(rates.speeds, all);
    track.peak_acceleration_deg_s2 = largest_in(rates.accelerations, all);
    speed = std::max(speed, track.peak_speed_deg_s);
    acceleration = std::max(acceleration, track.peak_acceleration_deg_s2);
    report_rates(track.name, rates, limits_of(track.name, settings), step, report);
  }
  report.figures.joint_speed_deg_s = speed;
  report.figures.joint_acceleration_deg_s2 = acceleration;
}

void check_jumps(const Take& clip, const RobotSettings& settings, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  const double limit_deg = at_rate(settings.jump_deg, clip.frame_rate_hz);
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const auto jumps = jumps_of(
        frames, limit_deg, [&](std::size_t f) { return clip.rotation(f, j); },
        [&](std::size_t f) { return clip.is_observed(f, j); });
    report_jumps(clip.skeleton.names[j], "deg", "turns within one frame and stays so", jumps,
                 report);
  }
  if (!(report.metres_per_unit > 0)) return;
  const double cm = 100 * report.metres_per_unit;
  const auto jumps = jumps_of(
      frames, at_rate(settings.jump_cm, clip.frame_rate_hz),
      [&](std::size_t f) { return cm * clip.root_position(f); },
      [&](std::size_t f) { return clip.is_position_observed(f, 0); });
  report_jumps(clip.skeleton.names[0], "cm", "moves within one frame and stays there", jumps,
               report);
}

void check_jumps(const Take& clip, const std::vector<std::size_t>& markers,
                 const RobotSettings& settings, CheckReport& report) {
  if (!(report.metres_per_unit > 0)) return;
  const double cm = 100 * report.metres_per_unit;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const auto jumps = jumps_of(
        clip.frame_count(), at_rate(settings.jump_cm, clip.frame_rate_hz),
        [&](std::size_t f) { return cm * clip.position(f, markers[i]); },
        [&](std::size_t f) { return clip.is_observed(f, markers[i]); });
    report_jumps(report.tracks[i].name, "cm", "moves within one frame and stays there", jumps,
                 report);
  }
}

}  // namespace kinemend::check
