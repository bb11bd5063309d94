// Integrates the heading into points of the path.
#include "lab/synthesis/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/portable.hpp"

namespace kinemend::synth {

namespace {

// The step of the table along the path. Chosen by hand, not swept.
constexpr double step_cm = 2;

}  // namespace

Path::Path(std::function<double(double)> heading_deg, double first, double last)
    : heading_(std::move(heading_deg)), first_(step_cm * std::floor(first / step_cm)) {
  const auto count = static_cast<std::size_t>(std::ceil((last - first_) / step_cm)) + 2;
  points_.resize(count);
  // Simpson's rule sums between the points, which are then shifted so that distance 0 is the
  // origin.
  for (std::size_t i = 1; i < count; ++i) {
    const double at = first_ + step_cm * static_cast<double>(i - 1);
    points_[i] = points_[i - 1] + (step_cm / 6) * (forward(at) + 4 * forward(at + step_cm / 2) +
                                                   forward(at + step_cm));
  }
  const Vec3 origin = points_[static_cast<std::size_t>(std::lround(-first_ / step_cm))];
  for (Vec3& p : points_) p = p - origin;
}

Vec3 Path::forward(double distance) const {
  const double a = heading_(distance) * radians_per_degree;
  return {portable::sin(a), 0, portable::cos(a)};
}

Vec3 Path::left(double distance) const {
  const Vec3 f = forward(distance);
  return {f.z, 0, -f.x};
}

Vec3 Path::position(double distance) const {
  const double place = (distance - first_) / step_cm;
  const double limit = static_cast<double>(points_.size() - 2);
  const double cell = std::clamp(std::floor(place), 0.0, limit);
  const auto i = static_cast<std::size_t>(cell);
  const double from = first_ + step_cm * cell;
  if (place < 0) return points_.front() + (distance - first_) * forward(first_);
  if (place > limit + 1) {
    const double end = from + step_cm;
    return points_.back() + (distance - end) * forward(end);
  }
  // Interpolates by a cubic Hermite curve with the known tangents.
  const double u = place - cell;
  const double h = u * u * (3 - 2 * u);
  return points_[i] + h * (points_[i + 1] - points_[i]) +
         (step_cm * u * (1 - u) * (1 - u)) * forward(from) -
         (step_cm * u * u * (1 - u)) * forward(from + step_cm);
}

}  // namespace kinemend::synth
