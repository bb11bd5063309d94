// Finds contacts and flights, and checks the body by them: feet that slide or sink, and a frame
// rate at which it would fall too fast or too slowly.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "check/checks.hpp"
#include "feet/floor.hpp"

namespace kinemend::check {

namespace {

using feet::ContactThresholds, feet::sole_point, feet::SolePoint, feet::touches;

// Follows the touching point that moves least from frame to frame; the foot turns about it.
Contact measure(const std::vector<SolePoint>& points,
                const std::vector<std::vector<std::uint8_t>>& touching, std::size_t foot,
                const FrameSpan& span, double frame_rate_hz) {
  Contact contact{foot, span, 0, {}};
  Vec3 travel;
  std::vector<double> x, y, z;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const SolePoint* slowest = nullptr;
    const SolePoint* lowest = nullptr;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (touching[p][f] == 0) continue;
      if (lowest == nullptr || points[p].heights[f] < lowest->heights[f]) lowest = &points[p];
      if (slowest == nullptr || norm(points[p].velocities[f]) < norm(slowest->velocities[f]))
        slowest = &points[p];
    }
    if (slowest != nullptr && f > span.first)
      travel += (1 / frame_rate_hz) * slowest->velocities[f];
    contact.slide_m = std::max(contact.slide_m, norm(travel));
    if (lowest == nullptr) continue;
    x.push_back(lowest->path[f].x), y.push_back(lowest->path[f].y), z.push_back(lowest->path[f].z);
  }
  contact.place = {median_of(x), median_of(y), median_of(z)};
  return contact;
}

}  // namespace

std::vector<SolePoint> sole_points(const BodyPoints& body, const Foot& foot, Up up) {
  std::vector<SolePoint> points;
  points.reserve(foot.points.size());
  for (const std::size_t index : foot.points) points.push_back(sole_point(body, index, up));
  return points;
}

std::vector<Contact> find_contacts(const BodyPoints& body, Up up) {
  // Chosen by hand, not swept.
  constexpr double shortest_s = 0.1;  // shorter contacts are dropped
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < body.feet.size(); ++i) {
    const std::vector<SolePoint> points = sole_points(body, body.feet[i], up);
    std::vector<std::vector<std::uint8_t>> touching;
    touching.reserve(points.size());
    for (const SolePoint& point : points)
      touching.push_back(touches(point, {point.level}, body.height, ContactThresholds{}));
    const auto down = [&](std::size_t f) {
      return std::any_of(touching.begin(), touching.end(),
                         [f](const std::vector<std::uint8_t>& t) { return t[f] != 0; });
    };
    for (const FrameSpan& span : runs_where(body.frames, down)) {
      if (static_cast<double>(span.length()) < shortest_s * body.frame_rate_hz) continue;
      contacts.push_back(measure(points, touching, i, span, body.frame_rate_hz));
    }
  }
  return contacts;
}

std::optional<Up> up_of_body(const BodyPoints& body, const CheckSettings& settings) {
  // Shorter takes say nothing about contacts. Chosen by hand, not swept.
  constexpr std::size_t fewest_frames = 10;
  if (body.feet.empty() || body.frames < fewest_frames) return std::nullopt;
  return settings.up ? Up{*settings.up, 1} : find_up(body);
}

std::vector<FrameSpan> find_flights(const BodyPoints& body, Up up) {
  // Chosen by hand, not swept.
  constexpr double clear_height = 0.03;  // body heights, of all points above their level
  std::vector<std::uint8_t> clear(body.frames, 1);
  for (const Foot& foot : body.feet) {
    for (const SolePoint& point : sole_points(body, foot, up)) {
      for (std::size_t f = 0; f < body.frames; ++f) {
        if (point.seen[f] == 0 || point.heights[f] - point.level < clear_height * body.height)
          clear[f] = 0;
      }
    }
  }
  return runs_where(body.frames, [&](std::size_t f) { return clear[f] != 0; });
}

double fall(const BodyPoints& body, Up up, const FrameSpan& span) {
  // With time centred, the second moment separates the quadratic term from the linear one.
  const auto count = static_cast<double>(span.length());
  const double middle = 0.5 * static_cast<double>(span.first + span.last);
  double mean_square = 0, mean_height = 0;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = (static_cast<double>(f) - middle) / body.frame_rate_hz;
    mean_square += t * t / count;
    mean_height += along(body.centres[f], up) / count;
  }
  double top = 0, bottom = 0;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = (static_cast<double>(f) - middle) / body.frame_rate_hz;
    top += (t * t - mean_square) * (along(body.centres[f], up) - mean_height);
    bottom += (t * t - mean_square) * (t * t - mean_square);
  }
  return bottom > 0 ? -2 * top / bottom : 0;
}

namespace {

// The number of frames in which a foot is low, and of those in which one has ground contact.
struct TimeOnFloor {
  std::size_t low = 0, standing = 0;
};

TimeOnFloor time_on_floor(const BodyPoints& body, Up up, const std::vector<Contact>& contacts) {
  // Body heights above the lowest level of the feet, which is this quantile. Chosen by hand, not
  // swept.
  constexpr double near_floor = 0.08, lowest_share = 0.05;
  std::vector<double> lowest(body.frames, std::numeric_limits<double>::infinity());
  for (const Foot& foot : body.feet) {
    for (const std::size_t point : foot.points) {
      for (std::size_t f = 0; f < body.frames; ++f) {
        if (body.is_observed(f, point))
          lowest[f] = std::min(lowest[f], along(body.at(f, point), up));
      }
    }
  }
  std::vector<std::uint8_t> stands(body.frames);
  for (const Contact& contact : contacts)
    std::fill_n(stands.begin() + static_cast<std::ptrdiff_t>(contact.span.first),
                contact.span.length(), std::uint8_t{1});
  std::vector<double> heights = lowest;
  const double floor = quantile_of(heights, lowest_share);
  TimeOnFloor time;
  for (std::size_t f = 0; f < body.frames; ++f) {
    if (!(lowest[f] < floor + near_floor * body.height)) continue;
    ++time.low;
    time.standing += stands[f];
  }
  return time;
}

// Whether the median height of the pelvis, or of the middle of all markers, is that of a person who
// stands or squats.
bool is_upright(const BodyPoints& body, Up up) {
  // Body heights above the lowest point of a foot. Chosen by hand, not swept.
  constexpr double least_height = 0.3;
  std::vector<double> heights;
  for (std::size_t f = 0; f < body.frames; ++f) {
    for (const Foot& foot : body.feet) {
      for (const std::size_t point : foot.points) {
        if (body.is_observed(f, point))
          heights.push_back(along(body.centres[f] - body.at(f, point), up));
      }
    }
  }
  return !heights.empty() && median_of(heights) > least_height * body.height;
}

// An upright person has ground contact now and then. Errors of video and depth cameras move
// standing feet, so that none is ever at rest.
void report_no_contact(const BodyPoints& body, Up up, const std::vector<Contact>& contacts,
                       CheckReport& report) {
  // The shortest take, because a jump may be shorter; the least share of time with a low foot; and
  // the largest share with contact that is reported. Chosen by hand, not swept.
  constexpr double shortest_s = 2, least_low = 0.5, most_standing = 0.1;
  const auto frames = static_cast<double>(body.frames);
  if (frames < shortest_s * body.frame_rate_hz || !is_upright(body, up)) return;
  const TimeOnFloor time = time_on_floor(body, up, contacts);
  const auto low = static_cast<double>(time.low), standing = static_cast<double>(time.standing);
  if (low < least_low * frames || standing > most_standing * low) return;
  report.findings.push_back(
      {FindingKind::no_contact, Severity::note, "", 0, body.frames - 1, 100 * standing / low, "%",
       "feet come near the floor and rarely rest on it, as in takes of video or of a body that "
       "walks on the spot; if the take comes from video, try: kinemend clean --source video"});
}

void report_feet(const BodyPoints& body, Up up, const CheckSettings& settings,
                 CheckReport& report) {
  // The distance in docs/check.md, `sink`. Chosen by hand, not swept.
  constexpr double close_m = 0.02;  // scale of the weights about the floor
  const std::vector<Contact> contacts = find_contacts(body, up);
  std::vector<Vec3> places;
  places.reserve(contacts.size());
  for (const Contact& contact : contacts) places.push_back(contact.place);
  const std::vector<double> depths = feet::depths_below_floor(places, up, close_m, 1);
  double slide_cm = 0, sink_cm = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const auto report_cm = [&](FindingKind kind, double cm, const char* words) {
      report.findings.push_back({kind, Severity::warning, body.feet[contact.foot].name,
                                 contact.span.first, contact.span.last, cm, "cm", words});
    };
    const double slide = 100 * contact.slide_m, sink = depths.empty() ? 0 : 100 * depths[i];
    slide_cm = std::max(slide_cm, slide);
    sink_cm = std::max(sink_cm, sink);
    if (slide > settings.slide_cm)
      report_cm(FindingKind::slide, slide, "slides during ground contact");
    if (sink > settings.sink_cm)
      report_cm(FindingKind::sink, sink, "is below the floor during ground contact");
  }
  report_no_contact(body, up, contacts, report);
  // Without ground contact, slide and sink are undefined.
  if (contacts.empty()) return;
  put_largest(slide_cm, report.figures.slide_cm);
  if (!depths.empty()) put_largest(sink_cm, report.figures.sink_cm);
}

// In the air a body falls at 9.81 m/s^2, and the pelvis does so within a third. A hanging or
// sitting body falls more slowly, so only a rate that is too high can be detected.
void report_rate_of_fall(const BodyPoints& body, Up up, CheckReport& report) {
  // The error of the rate is the square root of this ratio. Both limits are chosen by hand, not
  // swept.
  constexpr double gravity = 9.81, most_ratio = 2.5;  // a rate 1.6 times too high
  constexpr double least_height_m = 0.05;             // fall of the centre, above the noise
  // The number of flights that must agree, and the frames that determine a parabola. Chosen by
  // hand, not swept.
  constexpr std::size_t fewest_flights = 2, fewest_frames = 6;
  std::vector<double> falls;
  for (const FrameSpan& span : find_flights(body, up)) {
    if (span.length() < fewest_frames || span.first == 0 || span.last + 1 == body.frames) continue;
    const double found = fall(body, up, span);
    const double half_s = 0.5 * static_cast<double>(span.length()) / body.frame_rate_hz;
    if (0.5 * std::fabs(found) * half_s * half_s > least_height_m) falls.push_back(found);
  }
  if (falls.size() < fewest_flights) return;
  if (*std::min_element(falls.begin(), falls.end()) < most_ratio * gravity) return;
  const double found = median_of(falls);
  const double rate = report.frame_rate_hz / std::sqrt(found / gravity);
  report.findings.push_back(
      {FindingKind::rate, Severity::serious, "", 0, body.frames - 1, rate, "Hz",
       fmt::format("the body falls at {:.3g} m/s2, not 9.81: the frame rate may be about {:.0f} Hz",
                   found, rate)});
}

}  // namespace

std::vector<NamedBody> bodies_of(const Rows& rows, const CheckSettings& settings,
                                 const CheckReport& report) {
  std::vector<NamedBody> bodies;
  if (!(report.metres_per_unit > 0)) return bodies;
  if (rows.clip.has_joints())
    bodies.push_back({{}, body_points(rows.clip, report.metres_per_unit, settings.names)});
  for (const Subject& subject : rows.subjects) {
    bodies.push_back(
        {subject, body_points(rows.clip, subject.markers, report.metres_per_unit, settings.names)});
  }
  return bodies;
}

void check_body(const Rows& rows, const CheckSettings& settings, CheckReport& report) {
  bool has_rate = false;
  for (const auto& [subject, body] : bodies_of(rows, settings, report)) {
    CheckReport own;
    own.frame_rate_hz = report.frame_rate_hz;
    if (const std::optional<Up> up = up_of_body(body, settings)) {
      report_feet(body, *up, settings, own);
      report_rate_of_fall(body, *up, own);
    }
    for (Finding& finding : own.findings) {
      // The rate is the same for all people: one finding suffices.
      const bool is_rate = finding.kind == FindingKind::rate;
      if (is_rate && std::exchange(has_rate, true)) continue;
      if (!is_rate && !subject.name.empty()) finding.track = subject.name + " " + finding.track;
      report.findings.push_back(std::move(finding));
    }
    if (own.figures.slide_cm) put_largest(*own.figures.slide_cm, report.figures.slide_cm);
    if (own.figures.sink_cm) put_largest(*own.figures.sink_cm, report.figures.sink_cm);
    if (rows.subjects.size() > 1) {
      report.subjects.push_back(
          {subject.name, subject.markers.size(), own.figures.slide_cm, own.figures.sink_cm});
    }
  }
}

}  // namespace kinemend::check
