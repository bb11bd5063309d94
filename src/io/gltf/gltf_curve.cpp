// Decodes and evaluates channels (in steps, linear, and as cubic splines), and finds the frame rate
// from the times of their keys.
#include "io/gltf/gltf_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "io/gltf/gltf_model.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

// A larger number is treated as missing, as in every format.
constexpr double most_gltf_value = 1e100;

bool is_usable(const double* values, std::size_t count) {
  return std::all_of(values, values + count,
                     [](double value) { return std::fabs(value) <= most_gltf_value; });
}

std::vector<double> gltf_times(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                               std::size_t accessor) {
  const GltfNumbers numbers(file, model, buffers, accessor, 1);
  if (numbers.accessor().component != gltf_float)
    throw gltf_error(file, "accessors", accessor, "times are floats");
  if (numbers.count() == 0) throw gltf_error(file, "accessors", accessor, "no keys");
  std::vector<double> times = numbers.values();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]))
      throw gltf_error(file, "accessors", accessor, fmt::format("time {} is not finite", i));
    if (i > 0 && times[i] < times[i - 1])
      throw gltf_error(file, "accessors", accessor, fmt::format("time {} goes back", i));
  }
  return times;
}

// Replaces each key that is not finite by the key before, else by the next key.
void hold_missing_keys(GltfCurve& curve) {
  const std::size_t parts = curve.parts();
  const auto key_at = [&](std::size_t key) { return curve.values.data() + key * parts; };
  std::size_t good = curve.keys();
  for (std::size_t k = 0; k < curve.keys(); ++k) {
    if (is_usable(key_at(k), parts)) {
      if (good == curve.keys()) {
        for (std::size_t i = 0; i < k; ++i) std::copy_n(key_at(k), parts, key_at(i));
      }
      good = k;
      continue;
    }
    curve.held.resize(curve.keys());
    curve.held[k] = 1;
    if (good < curve.keys()) std::copy_n(key_at(good), parts, key_at(k));
  }
  if (good == curve.keys()) std::fill(curve.values.begin(), curve.values.end(), 0.0);
}

// Visits the segment of each time in turn: the last key that is not later, and the share of the
// step to the next key (0 at a key).
template <class Visit>
void walk_curve(const GltfCurve& curve, const GltfTimes& times, Visit&& visit) {
  const std::size_t last = curve.keys() - 1;
  std::size_t key = 0;
  for (std::size_t frame = 0; frame < times.count; ++frame) {
    const double t = times.at(frame);
    while (key < last && curve.times()[key + 1] <= t + times.tolerance_s) ++key;
    const bool between = key < last && t > curve.times()[key] + times.tolerance_s;
    const double length = key < last ? curve.times()[key + 1] - curve.times()[key] : 0;
    visit(frame, key, between && length > 0 ? (t - curve.times()[key]) / length : 0.0, length);
  }
}

// Evaluates a component of a spline: specification, appendix C.5.
double spline_value(const GltfCurve& curve, std::size_t key, std::size_t c, double s,
                    double length) {
  const std::size_t w = curve.width;
  const double* const a = curve.values.data() + key * 3 * w;
  const double* const b = a + 3 * w;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a[w + c] + length * (s3 - 2 * s2 + s) * a[2 * w + c] +
         (3 * s2 - 2 * s3) * b[w + c] + length * (s3 - s2) * b[c];
}

}  // namespace

Quat GltfCurve::rotation(std::size_t key) const {
  const double* const v = value(key);
  return unit_rotation({v[3], v[0], v[1], v[2]});
}

GltfCurve read_gltf_curve(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                          const GltfSampler& sampler, GltfPath path, GltfClocks& clocks) {
  GltfCurve curve;
  curve.interpolation = sampler.interpolation;
  curve.width = path == GltfPath::rotation ? 4 : 3;
  auto& clock = clocks[sampler.input];
  if (clock == nullptr)
    clock = std::make_shared<std::vector<double>>(gltf_times(file, model, buffers, sampler.input));
  curve.clock = clock;
  const GltfNumbers values(file, model, buffers, sampler.output, curve.width);
  const std::size_t wanted = curve.keys() * (curve.parts() / curve.width);
  if (values.count() != wanted) {
    throw gltf_error(file, "accessors", sampler.output,
                     fmt::format("expected {} elements for {} keys, found {}", wanted, curve.keys(),
                                 values.count()));
  }
  curve.values = values.values();
  hold_missing_keys(curve);
  return curve;
}

bool is_constant(const GltfCurve& curve) {
  for (std::size_t k = 1; k < curve.keys(); ++k) {
    if (!std::equal(curve.value(k), curve.value(k) + curve.width, curve.value(0))) return false;
  }
  if (curve.parts() == curve.width || curve.keys() == 1) return true;
  // A spline is constant only if its tangents are zero too.
  const auto is_zero = [](double value) { return value == 0; };
  for (std::size_t k = 0; k < curve.keys(); ++k) {
    const double* const v = curve.value(k);
    const auto width = static_cast<std::ptrdiff_t>(curve.width);
    if (!std::all_of(v - width, v, is_zero) || !std::all_of(v + width, v + 2 * width, is_zero))
      return false;
  }
  return true;
}

std::vector<Vec3> vectors_at(const GltfCurve& curve, const GltfTimes& times) {
  std::vector<Vec3> out(times.count);
  walk_curve(curve, times, [&](std::size_t frame, std::size_t key, double s, double length) {
    const Vec3 a = curve.vector(key);
    if (s == 0 || curve.interpolation == GltfInterpolation::step) {
      out[frame] = a;
    } else if (curve.interpolation == GltfInterpolation::linear) {
      out[frame] = (1 - s) * a + s * curve.vector(key + 1);
    } else {
      const auto part = [&](std::size_t c) { return spline_value(curve, key, c, s, length); };
      out[frame] = {part(0), part(1), part(2)};
    }
  });
  return out;
}

std::vector<Quat> rotations_at(const GltfCurve& curve, const GltfTimes& times) {
  std::vector<Quat> out(times.count);
  walk_curve(curve, times, [&](std::size_t frame, std::size_t key, double s, double length) {
    const Quat a = curve.rotation(key);
    if (s == 0 || curve.interpolation == GltfInterpolation::step) {
      out[frame] = a;
    } else if (curve.interpolation == GltfInterpolation::linear) {
      out[frame] = unit_rotation(slerp(a, curve.rotation(key + 1), s));
    } else {
      const auto part = [&](std::size_t c) { return spline_value(curve, key, c, s, length); };
      out[frame] = unit_rotation({part(3), part(0), part(1), part(2)});
    }
  });
  return out;
}

bool has_key_each_frame(const GltfCurve& curve, const GltfTimes& times) {
  if (curve.keys() != times.count) return false;
  for (std::size_t k = 0; k < curve.keys(); ++k) {
    if (std::fabs(curve.times()[k] - times.at(k)) > times.tolerance_s) return false;
  }
  return true;
}

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
