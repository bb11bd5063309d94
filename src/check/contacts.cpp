#include <algorithm>
#include <cmath>

#include "check/feet.hpp"

namespace kinemend::check {

namespace {

// As shares of the body's height, the speeds a second.
constexpr double begin_height = 0.015, go_on_height = 0.03;
constexpr double begin_speed = 0.15, go_on_speed = 0.25;

// One point of a foot, without the jitter that would pass for travel.
struct SolePoint {
  std::vector<Vec3> path;
  std::vector<double> heights;
  std::vector<Vec3> velocities;  // horizontal, m/s; of the step that ends in the frame
  std::vector<double> speeds;    // in all directions, m/s
  std::vector<std::uint8_t> seen;
  double level = 0;  // where it stands as a rule
};

// Mean over the frames within 20 ms in which the point is seen.
std::vector<Vec3> smoothed(const BodyPoints& body, std::size_t point) {
  const auto reach = static_cast<std::size_t>(std::lround(0.02 * body.frame_rate_hz));
  std::vector<Vec3> result(body.frames);
  for (std::size_t f = 0; f < body.frames; ++f) {
    // Symmetric, so that a straight path stays one.
    const std::size_t around = std::min({reach, f, body.frames - 1 - f});
    double count = 0;
    for (std::size_t k = f - around; k <= f + around; ++k) {
      if (!body.is_observed(k, point)) continue;
      result[f] += body.at(k, point);
      ++count;
    }
    if (count > 0) result[f] = (1 / count) * result[f];
  }
  return result;
}

double standing_level(const SolePoint& point, double body_height) {
  constexpr double low = 0.02, near_low = 0.06;
  std::vector<double> heights;
  for (std::size_t f = 0; f < point.heights.size(); ++f) {
    if (point.seen[f] != 0) heights.push_back(point.heights[f]);
  }
  const double lowest = quantile_of(heights, low);
  heights.clear();
  for (std::size_t f = 0; f < point.heights.size(); ++f) {
    const bool stands = point.seen[f] != 0 && point.speeds[f] < begin_speed * body_height &&
                        point.heights[f] < lowest + near_low * body_height;
    if (stands) heights.push_back(point.heights[f]);
  }
  return heights.empty() ? lowest : median_of(heights);
}

SolePoint sole_point(const BodyPoints& body, std::size_t index, Up up) {
  SolePoint point;
  point.path = smoothed(body, index);
  const std::vector<Vec3>& path = point.path;
  for (std::size_t f = 0; f < body.frames; ++f) {
    const std::size_t before = f == 0 ? 0 : f - 1;
    const Vec3 velocity = body.frame_rate_hz * (path[f] - path[before]);
    const double rise = along(velocity, up);
    Vec3 level = velocity;
    (up.axis == Axis::x ? level.x : up.axis == Axis::y ? level.y : level.z) = 0;
    point.heights.push_back(along(path[f], up));
    point.velocities.push_back(level);
    point.speeds.push_back(std::hypot(norm(level), rise));
    point.seen.push_back(body.is_observed(f, index) && body.is_observed(before, index) ? 1 : 0);
  }
  point.level = standing_level(point, body.height);
  return point;
}

std::vector<std::uint8_t> touches(const SolePoint& point, double body_height) {
  std::vector<std::uint8_t> result(point.heights.size());
  bool down = false;
  for (std::size_t f = 0; f < result.size(); ++f) {
    const double height = point.heights[f] - point.level;
    down = point.seen[f] != 0 && height < (down ? go_on_height : begin_height) * body_height &&
           point.speeds[f] < (down ? go_on_speed : begin_speed) * body_height;
    result[f] = down;
  }
  return result;
}

std::vector<SolePoint> sole_points(const BodyPoints& body, const Foot& foot, Up up) {
  std::vector<SolePoint> points;
  points.reserve(foot.points.size());
  for (const std::size_t index : foot.points) points.push_back(sole_point(body, index, up));
  return points;
}

// Follows, from frame to frame, the touching point that moves least: a foot turns about it.
Contact measure(const std::vector<SolePoint>& points,
                const std::vector<std::vector<std::uint8_t>>& touching, std::size_t foot,
                const Span& span, double frame_rate_hz) {
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

std::vector<Contact> find_contacts(const BodyPoints& body, Up up) {
  constexpr double shortest_s = 0.1;
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < body.feet.size(); ++i) {
    const std::vector<SolePoint> points = sole_points(body, body.feet[i], up);
    std::vector<std::vector<std::uint8_t>> touching;
    touching.reserve(points.size());
    for (const SolePoint& point : points) touching.push_back(touches(point, body.height));
    const auto down = [&](std::size_t f) {
      return std::any_of(touching.begin(), touching.end(),
                         [f](const std::vector<std::uint8_t>& t) { return t[f] != 0; });
    };
    for (std::size_t f = 0; f < body.frames; ++f) {
      if (!down(f)) continue;
      Span span{f, f};
      while (span.last + 1 < body.frames && down(span.last + 1)) ++span.last;
      f = span.last;
      if (static_cast<double>(span.length()) < shortest_s * body.frame_rate_hz) continue;
      contacts.push_back(measure(points, touching, i, span, body.frame_rate_hz));
    }
  }
  return contacts;
}

std::vector<Span> find_flights(const BodyPoints& body, Up up) {
  constexpr double clear_height = 0.03;
  std::vector<std::uint8_t> clear(body.frames, 1);
  for (const Foot& foot : body.feet) {
    for (const SolePoint& point : sole_points(body, foot, up)) {
      for (std::size_t f = 0; f < body.frames; ++f) {
        if (point.seen[f] == 0 || point.heights[f] - point.level < clear_height * body.height)
          clear[f] = 0;
      }
    }
  }
  std::vector<Span> flights;
  for (std::size_t f = 0; f < body.frames; ++f) {
    if (clear[f] == 0) continue;
    Span span{f, f};
    while (span.last + 1 < body.frames && clear[span.last + 1] != 0) ++span.last;
    f = span.last;
    flights.push_back(span);
  }
  return flights;
}

}  // namespace kinemend::check
