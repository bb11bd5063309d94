// Finds feet in or above the floor, times in the air, and the height of the floor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/quantiles.hpp"
#include "check/checks.hpp"
#include "check/feet.hpp"
#include "check/runs.hpp"
#include "feet/floor.hpp"
#include "feet/sole_point.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::check {

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

// Marks contacts of heels and toes of a take of joints, including those on steps, in the report.
void mark_contacts(const Take& clip, const CheckSettings& settings, const BodyPoints& body,
                   FeetByFrame& all, RobotFindings& robot) {
  Take named = clip;
  named.skeleton.names = known_names(clip.skeleton.names, settings.names);
  const std::vector<Leg> legs = find_legs(named.skeleton);
  ContactSettings contact;
  contact.up = settings.up;
  robot.contacts = find_contacts(named, contact);
  for (const Leg& leg : legs) robot.sides.push_back(leg.side);
  for (const FootContact& one : robot.contacts) {
    const std::string& ankle = clip.skeleton.names[static_cast<std::size_t>(legs[one.leg].ankle)];
    for (std::size_t i = 0; i < body.feet.size(); ++i) {
      if (body.feet[i].name == ankle) mark(all.stands[i], one.first_frame, one.last_frame);
    }
  }
}

double deepest_in(const std::vector<double>& depths, const FrameSpan& span) {
  return *std::max_element(depths.begin() + static_cast<std::ptrdiff_t>(span.first),
                           depths.begin() + static_cast<std::ptrdiff_t>(span.last + 1));
}

void put_larger(double value, std::optional<double>& known) {
  known = std::max(value, known.value_or(0));
}

void report_penetration(const BodyPoints& body, const FeetByFrame& all,
                        const RobotSettings& settings, CheckReport& report) {
  for (std::size_t i = 0; i < body.feet.size(); ++i) {
    const std::vector<double>& depths = all.depths[i];
    put_larger(100 * deepest_in(depths, {0, body.frames - 1}), report.figures.penetration_cm);
    const auto is_deep = [&](std::size_t f) { return 100 * depths[f] > settings.penetration_cm; };
    for (const FrameSpan& span : runs_where(body.frames, is_deep)) {
      report.findings.push_back({FindingKind::penetration, Severity::warning, body.feet[i].name,
                                 span.first, span.last, 100 * deepest_in(depths, span), "cm",
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
      put_larger(cm, report.figures.floating_cm);
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

std::optional<Up> up_of_body(const BodyPoints& body, const CheckSettings& settings) {
  constexpr std::size_t fewest_frames = 10;
  if (body.feet.empty() || body.frames < fewest_frames) return std::nullopt;
  return settings.up ? Up{*settings.up, 1} : find_up(body);
}

}  // namespace

void check_robot_feet(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  RobotFindings& robot = report.robot.emplace();
  if (!(report.metres_per_unit > 0)) return;
  const BodyPoints body = body_points(clip, report.metres_per_unit, settings.names);
  const std::optional<Up> up = up_of_body(body, settings);
  if (!up) return;
  FeetByFrame all = feet_by_frame(body, *up);
  mark_contacts(clip, settings, body, all, robot);
  report_penetration(body, all, *settings.robot, report);
  report_floating_feet(body, all, *settings.robot, report);
  report_flights(body, *up, all, report);
  report_floor(body, *up, *settings.robot, report);
}

void check_robot_feet(const Take& clip, const std::vector<Subject>& subjects,
                      const CheckSettings& settings, CheckReport& report) {
  report.robot.emplace();
  if (!(report.metres_per_unit > 0)) return;
  for (const Subject& subject : subjects) {
    const BodyPoints body =
        body_points(clip, subject.markers, report.metres_per_unit, settings.names);
    const std::optional<Up> up = up_of_body(body, settings);
    if (!up) continue;
    const std::size_t known = report.findings.size();
    FeetByFrame all = feet_by_frame(body, *up);
    for (const Contact& contact : find_contacts(body, *up))
      mark(all.stands[contact.foot], contact.span.first, contact.span.last);
    report_penetration(body, all, *settings.robot, report);
    report_flights(body, *up, all, report);
    for (std::size_t i = known; i < report.findings.size() && !subject.name.empty(); ++i) {
      Finding& finding = report.findings[i];
      finding.track = finding.track.empty() ? subject.name : subject.name + " " + finding.track;
    }
  }
}

}  // namespace kinemend::check
