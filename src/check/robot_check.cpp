// Checks a take for a robot: joints that exceed their limits, values that jump within one frame,
// feet in or above the floor, and times in the air.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "check/checks.hpp"
#include "feet/floor.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/feet.hpp"
#include "motion/take.hpp"

namespace kinemend::check {

namespace {

// The joints from the root to the first with several children carry the whole body, so no motor
// turns them.
std::vector<std::uint8_t> motor_joints(const Skeleton& skeleton) {
  const std::vector<std::size_t> children = child_counts(skeleton);
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
  return runs_where(
      values.size(), [&](std::size_t f) { return values[f] > limit; },
      frames_in(bridged_s, frame_rate_hz, 1) - 1);
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
}

// Finds and reports the jumps of the root or a marker, row `n`; returns how many there are.
std::size_t find_place_jumps(const Rows& rows, std::size_t n, double limit_cm,
                             CheckReport& report) {
  const Take& clip = rows.clip;
  const bool joints = clip.has_joints();
  const std::size_t point = joints ? 0 : rows.tracks[n];
  const double cm = 100 * report.metres_per_unit;
  const auto jumps = jumps_of(
      clip.frame_count(), at_rate(limit_cm, clip.frame_rate_hz),
      [&](std::size_t f) { return cm * clip.position(f, point); },
      [&](std::size_t f) {
        return joints ? clip.is_position_observed(f, point) : clip.is_observed(f, point);
      });
  report_jumps(report.tracks[n].name, "cm", "moves within one frame and stays there", jumps,
               report);
  return jumps.size();
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

void check_jumps(const Rows& rows, const RobotSettings& settings, CheckReport& report) {
  const Take& clip = rows.clip;
  const bool joints = clip.has_joints();
  const std::size_t frames = clip.frame_count();
  const double limit_deg = at_rate(settings.jump_deg, clip.frame_rate_hz);
  const auto count = [&](std::size_t jumps) {
    report.figures.jumps = report.figures.jumps.value_or(0) + jumps;
  };
  for (std::size_t j = 0; joints && j < clip.joint_count(); ++j) {
    const auto jumps = jumps_of(
        frames, limit_deg, [&](std::size_t f) { return clip.rotation(f, j); },
        [&](std::size_t f) { return clip.is_observed(f, j); });
    report_jumps(clip.skeleton.names[j], "deg", "turns within one frame and stays so", jumps,
                 report);
    count(jumps.size());
  }
  if (!(report.metres_per_unit > 0)) return;
  // In a take of joints only the root is checked.
  for (std::size_t n = 0; n < (joints ? 1 : rows.tracks.size()); ++n)
    count(find_place_jumps(rows, n, settings.jump_cm, report));
}

void check_root_jumps(const Rows& rows, CheckReport& report) {
  // Thirty metres a second faster than just before and after: no body does that. Chosen by hand.
  constexpr double impossible_cm = 50;
  if (rows.clip.has_joints() && report.metres_per_unit > 0)
    find_place_jumps(rows, 0, impossible_cm, report);
}

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

// Feet by frame, in metres: the height of the point nearest to its standing level, the depth of the
// foot below the lowest of these levels, and whether it has ground contact.
struct FeetByFrame {
  std::vector<std::vector<double>> heights, depths;
  std::vector<std::vector<std::uint8_t>> stands;
};

std::vector<double> heights_of(const std::vector<feet::SolePoint>& points, std::size_t frames) {
  std::vector<double> lowest(frames, nowhere);
  for (const feet::SolePoint& point : points) {
    for (std::size_t f = 0; f < frames; ++f) {
      if (point.seen[f] != 0) lowest[f] = std::min(lowest[f], point.heights[f] - point.level);
    }
  }
  return lowest;
}

// A toe that points down is lower than its standing level; the floor is the level of the lowest
// standing point.
std::vector<double> depths_of(const std::vector<feet::SolePoint>& points, std::size_t frames) {
  double floor = nowhere;
  for (const feet::SolePoint& point : points) floor = std::min(floor, point.level);
  std::vector<double> deepest(frames);
  for (const feet::SolePoint& point : points) {
    for (std::size_t f = 0; f < frames; ++f) {
      if (point.seen[f] != 0) deepest[f] = std::max(deepest[f], floor - point.heights[f]);
    }
  }
  return deepest;
}

FeetByFrame feet_by_frame(const BodyPoints& body, Up up) {
  FeetByFrame all;
  for (const Foot& foot : body.feet) {
    const std::vector<feet::SolePoint> points = sole_points(body, foot, up);
    all.heights.push_back(heights_of(points, body.frames));
    all.depths.push_back(depths_of(points, body.frames));
    all.stands.emplace_back(body.frames);
  }
  return all;
}

void mark(std::vector<std::uint8_t>& flags, std::size_t first, std::size_t last) {
  std::fill(flags.begin() + static_cast<std::ptrdiff_t>(first),
            flags.begin() + static_cast<std::ptrdiff_t>(last + 1), std::uint8_t{1});
}

// Marks the stands of heels and toes of a take of joints, including those on steps. `clip` and
// `body` have no calibration frames, in which no foot stands.
void mark_stands(const Take& clip, const BodyPoints& body, const CheckReport& report,
                 FeetByFrame& all) {
  const FootStands& stands = report.stands;
  for (const FootContact& one : stands.contacts) {
    const std::string& ankle = clip.skeleton.names[stands.tracks[one.leg].front()];
    for (std::size_t i = 0; i < body.feet.size(); ++i) {
      if (body.feet[i].name == ankle)
        mark(all.stands[i], one.first_frame - report.calibration_frames,
             one.last_frame - report.calibration_frames);
    }
  }
}

void report_penetration(const BodyPoints& body, const FeetByFrame& all,
                        const RobotSettings& settings, CheckReport& report) {
  for (std::size_t i = 0; i < body.feet.size(); ++i) {
    const std::vector<double>& depths = all.depths[i];
    put_largest(100 * largest_in(depths, {0, body.frames - 1}), report.figures.penetration_cm);
    const auto is_deep = [&](std::size_t f) { return 100 * depths[f] > settings.penetration_cm; };
    for (const FrameSpan& span : runs_where(body.frames, is_deep)) {
      report.findings.push_back({FindingKind::penetration, Severity::warning, body.feet[i].name,
                                 span.first, span.last, 100 * largest_in(depths, span), "cm",
                                 "goes below the level on which it stands"});
    }
  }
}

void report_floating_feet(const BodyPoints& body, const FeetByFrame& all,
                          const RobotSettings& settings, CheckReport& report) {
  for (std::size_t i = 0; i < body.feet.size(); ++i) {
    const auto stands = [&](std::size_t f) { return all.stands[i][f] != 0; };
    for (const FrameSpan& span : runs_where(body.frames, stands)) {
      std::vector<double> heights;
      for (std::size_t f = span.first; f <= span.last; ++f) {
        if (all.heights[i][f] != nowhere) heights.push_back(all.heights[i][f]);
      }
      if (heights.empty()) continue;
      const double cm = 100 * median_of(heights);
      put_largest(std::max(cm, 0.0), report.figures.floating_cm);
      if (cm <= settings.floating_cm) continue;
      report.findings.push_back({FindingKind::floating, Severity::warning, body.feet[i].name,
                                 span.first, span.last, cm, "cm",
                                 "stands above the floor: on a step, or in the air"});
    }
  }
}

// Whether a time in the air is not a fall: the pelvis falls at about 9.81 m/s2, but a hanging or
// sitting body does not. In short times the two cannot be distinguished.
bool is_carried(const BodyPoints& body, Up up, const FrameSpan& span) {
  constexpr double least_s = 0.2, least_fall = 0.5 * 9.81;
  const double seconds = static_cast<double>(span.length()) / body.frame_rate_hz;
  return seconds >= least_s && fall(body, up, span) < least_fall;
}

void report_flights(const BodyPoints& body, Up up, const FeetByFrame& all, CheckReport& report) {
  constexpr double shortest_s = 0.05;
  std::size_t flights = 0;
  const auto stands = [&](std::size_t f) {
    return std::any_of(all.stands.begin(), all.stands.end(),
                       [f](const std::vector<std::uint8_t>& foot) { return foot[f] != 0; });
  };
  for (const FrameSpan& clear : find_flights(body, up)) {
    const auto in_the_air = [&](std::size_t k) { return !stands(clear.first + k); };
    for (const FrameSpan& part : runs_where(clear.length(), in_the_air)) {
      const FrameSpan span{clear.first + part.first, clear.first + part.last};
      const double seconds = static_cast<double>(span.length()) / body.frame_rate_hz;
      if (seconds < shortest_s) continue;
      ++flights;
      const bool carried = is_carried(body, up, span);
      report.findings.push_back(
          {carried ? FindingKind::floating : FindingKind::flight,
           carried ? Severity::warning : Severity::note, "", span.first, span.last, seconds, "s",
           carried ? "no foot touches the floor, and the body does not fall: it is carried, or "
                     "floats"
                   : "no foot touches the floor"});
    }
  }
  report.figures.flights = report.figures.flights.value_or(0) + flights;
}

void report_floor(const BodyPoints& body, Up up, const RobotSettings& settings,
                  CheckReport& report) {
  const double cm = 100 * feet::floor_height(body, up);
  report.figures.floor_cm = std::fabs(cm);
  if (std::fabs(cm) <= settings.floor_cm) return;
  report.findings.push_back(
      {FindingKind::floor, Severity::note, "", 0, body.frames - 1, cm, "cm",
       fmt::format("the floor is {} height 0; convert --floor-at-zero moves it there",
                   cm > 0 ? "above" : "below")});
}

}  // namespace

void check_robot_feet(const Rows& rows, const CheckSettings& settings, CheckReport& report) {
  report.robot.emplace();
  for (const auto& [subject, body] : bodies_of(rows, settings, report)) {
    const std::optional<Up> up = up_of_body(body, settings);
    if (!up) continue;
    const std::size_t known = report.findings.size();
    FeetByFrame all = feet_by_frame(body, *up);
    if (rows.clip.has_joints()) {
      *report.robot = {report.stands.sides, report.stands.contacts};
      mark_stands(rows.clip, body, report, all);
    } else {
      for (const Contact& contact : find_contacts(body, *up))
        mark(all.stands[contact.foot], contact.span.first, contact.span.last);
    }
    report_penetration(body, all, *settings.robot, report);
    if (rows.clip.has_joints()) report_floating_feet(body, all, *settings.robot, report);
    report_flights(body, *up, all, report);
    if (rows.clip.has_joints()) report_floor(body, *up, *settings.robot, report);
    for (std::size_t i = known; i < report.findings.size() && !subject.name.empty(); ++i) {
      Finding& finding = report.findings[i];
      finding.track = finding.track.empty() ? subject.name : subject.name + " " + finding.track;
    }
  }
}

}  // namespace kinemend::check
