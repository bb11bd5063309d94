// Finds the spans in which a foot has ground contact and those in which the body is in the air.
#include <algorithm>
#include <cmath>

#include "check/feet.hpp"
#include "check/runs.hpp"
#include "feet/sole_point.hpp"

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
  // Heights and speeds are means over this time on either side. Chosen by hand, not swept.
  constexpr double reach_s = 0.02;
  std::vector<SolePoint> points;
  points.reserve(foot.points.size());
  for (const std::size_t index : foot.points)
    points.push_back(sole_point(body, index, up, ContactThresholds{}, reach_s));
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

}  // namespace kinemend::check
