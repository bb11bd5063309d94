// Finds the frame rate of an animation from the times of its keys.
#include "io/gltf/gltf_time_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/gltf.md).
constexpr double gltf_rate_when_unknown_hz = 30;
// The rates of films, games and cameras. Whole rates come first, because short takes fit both
// kinds. Chosen by hand.
constexpr std::array<double, 16> usual_gltf_rates{
    24, 25, 30, 48, 50, 60, 90, 100, 120, 144, 23.976, 29.97, 59.94, 119.88, 239.76, 240};

double float_error(double time_s) {
  return 4 * static_cast<double>(std::numeric_limits<float>::epsilon()) * std::fabs(time_s);
}

// Two times that are closer than this are the same time.
double least_step_s(double time_s) { return std::max(2e-5, float_error(time_s)); }

double key_tolerance_s(double rate_hz, double largest_time_s) {
  return std::min(0.1 / rate_hz, 1e-3 + float_error(largest_time_s));
}

std::vector<double> all_times(const std::vector<const GltfCurve*>& curves) {
  std::vector<double> times;
  std::set<const std::vector<double>*> clocks;
  for (const GltfCurve* curve : curves) {
    if (clocks.insert(curve->clock.get()).second)
      times.insert(times.end(), curve->times().begin(), curve->times().end());
  }
  std::sort(times.begin(), times.end());
  const auto same = [](double a, double b) { return b - a < least_step_s(b); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

bool lie_on_grid(const std::vector<double>& times, double rate_hz, double tolerance_s) {
  return std::all_of(times.begin(), times.end(), [&](double t) {
    const double frame = (t - times.front()) * rate_hz;
    return std::fabs(frame - std::round(frame)) <= tolerance_s * rate_hz;
  });
}

// Returns the usual rate or whole number that a rate equals except for rounding.
double rounded_rate(double rate_hz, double relative) {
  for (const double usual : usual_gltf_rates) {
    if (std::fabs(rate_hz / usual - 1) <= std::max(relative, 1e-4)) return usual;
  }
  const double whole = std::round(rate_hz);
  return whole >= 1 && std::fabs(rate_hz / whole - 1) <= relative ? whole : rate_hz;
}

// Returns the rate by the least distance of two keys; 0 if the keys do not fit it.
double rate_by_steps(const std::vector<double>& times) {
  double step = times.back() - times.front();
  for (std::size_t i = 1; i < times.size(); ++i) step = std::min(step, times[i] - times[i - 1]);
  const double span = times.back() - times.front(), steps = std::round(span / step);
  if (steps + 1 > 2 * static_cast<double>(times.size())) return 0;
  const double largest = std::max(std::fabs(times.front()), std::fabs(times.back()));
  const double rate = rounded_rate(steps / span, std::max(1e-6, float_error(largest) / span));
  if (!is_usable_frame_rate(rate)) return 0;
  return lie_on_grid(times, rate, key_tolerance_s(rate, largest)) ? rate : 0;
}

double rate_by_custom(const std::vector<double>& times) {
  const double largest = std::max(std::fabs(times.front()), std::fabs(times.back()));
  for (const double rate : usual_gltf_rates) {
    // Any time is near a frame of a fast rate, so only rounding errors are accepted.
    const double tolerance_s = std::min(0.01 / rate, 1e-4) + float_error(largest);
    if (lie_on_grid(times, rate, tolerance_s)) return rate;
  }
  return 0;
}

}  // namespace

GltfGrid grid_of_curves(const std::vector<const GltfCurve*>& curves, double rate_hz) {
  std::vector<const GltfCurve*> moving;
  for (const GltfCurve* curve : curves) {
    if (!is_constant(*curve)) moving.push_back(curve);
  }
  const std::vector<double> times = all_times(moving.empty() ? curves : moving);
  GltfGrid grid;
  grid.times.rate_hz = rate_hz > 0 ? rate_hz : gltf_rate_when_unknown_hz;
  if (times.empty()) return grid;
  grid.times.start_s = times.front();
  grid.times.count = 1;
  grid.is_assumed = times.size() < 2;
  const double span = times.back() - times.front();
  if (!grid.is_assumed) {
    double found = rate_by_steps(times);
    if (found == 0) found = rate_by_custom(times);
    grid.is_of_keys = found > 0;
    if (found > 0) grid.times.rate_hz = found;
    const double frames = grid.is_of_keys ? std::round(span * grid.times.rate_hz)
                                          : std::ceil(span * grid.times.rate_hz - 1e-6);
    constexpr double most = 1e9;  // too large for any file
    grid.times.count = 1 + static_cast<std::size_t>(std::min(frames, most));
  }
  const double largest = std::max(std::fabs(times.front()), std::fabs(times.back()));
  grid.times.tolerance_s = grid.is_of_keys ? key_tolerance_s(grid.times.rate_hz, largest) : 1e-6;
  return grid;
}

}  // namespace kinemend
