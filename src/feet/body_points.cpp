// Finds the axis along which a body is above its feet.
#include "feet/body_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace kinemend::feet {

double along(Vec3 v, Up up) {
  return up.sign * (up.axis == Axis::x ? v.x : up.axis == Axis::y ? v.y : v.z);
}

Vec3 level_part(Vec3 v, Up up) {
  (up.axis == Axis::x ? v.x : up.axis == Axis::y ? v.y : v.z) = 0;
  return v;
}

std::optional<Up> find_up(const BodyPoints& body) {
  // The least ratio of the distance from feet to the body's middle along one axis to that along any
  // other. Chosen by hand, not swept.
  constexpr double clear_ratio = 2;
  Vec3 sum;
  for (std::size_t f = 0; f < body.frames; ++f) {
    for (const Foot& foot : body.feet) {
      const std::size_t point = foot.points.front();
      if (body.is_observed(f, point)) sum += body.centres[f] - body.at(f, point);
    }
  }
  std::array<std::pair<double, Up>, 3> axes{
      {{std::fabs(sum.x), {Axis::x, sum.x < 0 ? -1.0 : 1.0}},
       {std::fabs(sum.y), {Axis::y, sum.y < 0 ? -1.0 : 1.0}},
       {std::fabs(sum.z), {Axis::z, sum.z < 0 ? -1.0 : 1.0}}}};
  std::sort(axes.begin(), axes.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  if (!(axes[0].first > clear_ratio * axes[1].first)) return std::nullopt;
  return axes[0].second;
}

}  // namespace kinemend::feet
