#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/checks.hpp"
#include "check/feet.hpp"

namespace kinemend::check {

namespace {

void report_feet(const BodyPoints& body, const std::vector<Contact>& contacts,
                 const CheckSettings& settings, CheckReport& report) {
  double slide_cm = 0, sink_cm = 0;
  for (const Contact& contact : contacts) {
    const std::string& foot = body.feet[contact.foot].name;
    const auto report_cm = [&](FindingKind kind, double cm, const char* words) {
      report.findings.push_back(
          {kind, Severity::warning, foot, contact.span.first, contact.span.last, cm, "cm", words});
    };
    slide_cm = std::max(slide_cm, 100 * contact.slide_m);
    sink_cm = std::max(sink_cm, 100 * contact.sink_m);
    if (100 * contact.slide_m > settings.slide_cm)
      report_cm(FindingKind::slide, 100 * contact.slide_m, "slides while it stands");
    if (100 * contact.sink_m > settings.sink_cm)
      report_cm(FindingKind::sink, 100 * contact.sink_m, "stands below its floor");
  }
  report.figures.slide_cm = slide_cm;
  report.figures.sink_cm = sink_cm;
}

// Acceleration of the least-squares parabola through heights, m/s^2, downwards.
double fall(const BodyPoints& body, Up up, const Span& span) {
  // With time centred, the second moment parts the square from the line.
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

// In the air a body falls at 9.81 m/s^2 whatever it does; the pelvis follows it within a third.
void report_rate_of_fall(const BodyPoints& body, Up up, CheckReport& report) {
  constexpr double gravity = 9.81, least_ratio = 0.4, most_ratio = 2.5;  // about 1.6 in rate
  constexpr double least_height_m = 0.05;  // that the centre falls: what noise does not
  constexpr std::size_t fewest_flights = 2, fewest_frames = 6;
  std::vector<double> falls;
  for (const Span& span : find_flights(body, up)) {
    if (span.length() < fewest_frames || span.first == 0 || span.last + 1 == body.frames) continue;
    const double found = fall(body, up, span);
    const double half_s = 0.5 * static_cast<double>(span.length()) / body.frame_rate_hz;
    if (0.5 * std::fabs(found) * half_s * half_s > least_height_m) falls.push_back(found);
  }
  if (falls.size() < fewest_flights) return;
  const auto [slowest, fastest] = std::minmax_element(falls.begin(), falls.end());
  if (*slowest >= least_ratio * gravity && *fastest <= most_ratio * gravity) return;
  if (!(*fastest < least_ratio * gravity || *slowest > most_ratio * gravity)) return;
  if (*slowest <= 0) return;
  const double found = median_of(falls);
  const double rate = report.frame_rate_hz / std::sqrt(found / gravity);
  report.findings.push_back(
      {FindingKind::rate, Severity::serious, "", 0, body.frames - 1, rate, "Hz",
       fmt::format("in the air the body falls at {:.3g} m/s2: the rate may be about {:.0f} Hz",
                   found, rate)});
}

void check_points(const BodyPoints& body, const CheckSettings& settings, CheckReport& report) {
  constexpr std::size_t fewest_frames = 10;
  if (body.feet.empty() || body.frames < fewest_frames) return;
  const std::optional<Up> up = settings.up ? Up{*settings.up, 1} : find_up(body);
  if (!up) return;
  report_feet(body, find_contacts(body, *up), settings, report);
  report_rate_of_fall(body, *up, report);
}

}  // namespace

void check_body(const Clip& clip, const CheckSettings& settings, CheckReport& report) {
  if (report.metres_per_unit > 0)
    check_points(body_points(clip, report.metres_per_unit), settings, report);
}

void check_body(const MarkerClip& clip, const std::vector<std::size_t>& markers,
                const CheckSettings& settings, CheckReport& report) {
  if (report.metres_per_unit > 0)
    check_points(body_points(clip, markers, report.metres_per_unit), settings, report);
}

}  // namespace kinemend::check
