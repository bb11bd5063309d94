// Removes spikes by a running median and fits parabolas with Gaussian weights.
#include "body/body_trend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "body/representation.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend::representation {

namespace {

// Puts samples of weight 0 on the straight line between their neighbours, and holds the ends.
template <class Value>
void bridge(std::vector<Value>& track, std::span<const double> weights) {
  const std::size_t frames = track.size();
  std::size_t before = frames;  // the last known frame; `frames`: none yet
  for (std::size_t f = 0; f < frames; ++f) {
    if (!(weights[f] > 0)) continue;
    for (std::size_t g = before == frames ? 0 : before + 1; g < f; ++g) {
      if (before == frames) {
        track[g] = track[f];
        continue;
      }
      const double u = static_cast<double>(g - before) / static_cast<double>(f - before);
      track[g] = track[before] + u * (track[f] - track[before]);
    }
    before = f;
  }
  const Value last = before == frames ? Value{} : track[before];
  for (std::size_t g = before == frames ? 0 : before + 1; g < frames; ++g) track[g] = last;
}

double middle_of(std::vector<double>& values) { return upper_median_of(values); }

Vec3 middle_of(std::vector<Vec3>& values) {
  Vec3 best = values.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 candidate : values) {
    double sum = 0;
    for (const Vec3 other : values) sum += norm(candidate - other);
    if (sum < least) {
      least = sum;
      best = candidate;
    }
  }
  return best;
}

// Windows stay centred near the ends, so that a straight line is unchanged; the end samples follow
// Tukey's rule, which also removes a spike there.
template <class Value>
std::vector<Value> running_median(const std::vector<Value>& track, std::size_t half_window) {
  const std::size_t frames = track.size();
  std::vector<Value> result(track), window;
  for (std::size_t f = 1; f + 1 < frames; ++f) {
    const std::size_t half = std::min({half_window, f, frames - 1 - f});
    const auto first = track.begin() + static_cast<std::ptrdiff_t>(f - half);
    window.assign(first, first + static_cast<std::ptrdiff_t>(2 * half + 1));
    result[f] = middle_of(window);
  }
  const auto end_value = [&](Value end, Value next, Value second) {
    window = {end, next, next + 2 * (next - second)};
    return middle_of(window);
  };
  if (frames >= 3) {
    result.front() = end_value(track.front(), result[1], result[2]);
    result.back() = end_value(track.back(), result[frames - 2], result[frames - 3]);
  }
  return result;
}

template <class Value>
std::vector<Value> despiked(std::vector<Value> track, std::span<const double> weights,
                            double frame_rate_hz) {
  // The window of the median: see docs/details/bodies.md, "Trend". Chosen by hand, not swept.
  constexpr double median_s = 0.1;
  bridge(track, weights);
  const double half_window =
      std::max(2.0, std::round(0.5 * median_s * window_rate_hz(frame_rate_hz)));
  return running_median(track, static_cast<std::size_t>(half_window));
}

// Fits parabolas with Gaussian weights; towards the ends of the track they become straight lines,
// because noise bends those less.
class LocalFit {
 public:
  LocalFit(const std::vector<double>& track, const std::vector<double>& weights,
           double deviation_frames)
      : track_(track),
        weights_(weights),
        kernel_(static_cast<std::size_t>(std::ceil(3 * deviation_frames)) + 1),
        end_frames_(1.5 * deviation_frames) {
    for (std::size_t k = 0; k < kernel_.size(); ++k) {
      const double z = static_cast<double>(k) / deviation_frames;
      kernel_[k] = portable::exp(-0.5 * z * z);
    }
  }

  double at(std::size_t frame) const {
    const Sums sums = sums_around(frame);
    const double line = sums.line();
    const auto to_end = static_cast<double>(std::min(frame, track_.size() - 1 - frame));
    const double u = std::min(1.0, to_end / end_frames_);
    return line + smooth_step(u) * (sums.parabola(line) - line);
  }

 private:
  // Sums of w k^i and w k^i y, where k counts frames from the middle.
  struct Sums {
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, t0 = 0, t1 = 0, t2 = 0;

    double line() const {
      const double determinant = s0 * s2 - s1 * s1;
      return determinant > 1e-9 * s0 * s2 ? (s2 * t0 - s1 * t1) / determinant : t0 / s0;
    }
    // `instead`: returned if the samples do not determine a parabola.
    double parabola(double instead) const {
      const double a = s2 * s4 - s3 * s3, b = s2 * s3 - s1 * s4, c = s1 * s3 - s2 * s2;
      const double determinant = s0 * a + s1 * b + s2 * c;
      if (!(determinant > 1e-6 * s0 * s2 * s4)) return instead;
      return (a * t0 + b * t1 + c * t2) / determinant;
    }
  };

  Sums sums_around(std::size_t frame) const {
    const std::size_t reach = kernel_.size() - 1;
    const std::size_t last = std::min(track_.size() - 1, frame + reach);
    Sums sums;
    for (std::size_t g = frame > reach ? frame - reach : 0; g <= last; ++g) {
      const double k = static_cast<double>(g) - static_cast<double>(frame);
      const double w = weights_[g] * kernel_[g > frame ? g - frame : frame - g];
      const double wk = w * k, wkk = wk * k, y = track_[g];
      sums.s0 += w;
      sums.s1 += wk;
      sums.s2 += wkk;
      sums.s3 += wkk * k;
      sums.s4 += wkk * k * k;
      sums.t0 += w * y;
      sums.t1 += wk * y;
      sums.t2 += wkk * y;
    }
    return sums;
  }

  const std::vector<double>& track_;
  const std::vector<double>& weights_;
  std::vector<double> kernel_;
  double end_frames_;
};

// Interpolates between four equally spaced values: u = 0 at the second, 1 at the third.
double cubic(const double* y, double u) {
  const double a = u + 1, b = u, c = u - 1, d = u - 2;
  return -y[0] * b * c * d / 6 + y[1] * a * c * d / 2 - y[2] * a * b * d / 2 + y[3] * a * b * c / 6;
}

// The trend bends so little that a value every eighth of the deviation suffices, except at the
// ends, where a value has no neighbours.
std::vector<double> local_fit(const std::vector<double>& track, std::span<const double> weights,
                              double deviation_frames) {
  // Bridged samples have almost no weight, but leave no frame without any sample. Chosen by hand,
  // not swept.
  constexpr double least_weight = 1e-4;
  const std::size_t frames = track.size();
  std::vector<double> known(weights.begin(), weights.end()), trend(frames);
  for (double& weight : known) weight = std::max(weight, least_weight);
  const LocalFit fit(track, known, deviation_frames);
  const auto step = static_cast<std::size_t>(std::max(1.0, std::floor(deviation_frames / 8)));
  std::vector<double> knots;
  for (std::size_t f = 0; f < frames; f += step) knots.push_back(fit.at(f));
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t knot = f / step;
    if (f % step == 0)
      trend[f] = knots[knot];
    else if (knot == 0 || knot + 2 >= knots.size())
      trend[f] = fit.at(f);
    else
      trend[f] = cubic(&knots[knot - 1], static_cast<double>(f % step) / static_cast<double>(step));
  }
  return trend;
}

double deviation_frames(double frame_rate_hz, double deviation_s) {
  return std::max(deviation_s * window_rate_hz(frame_rate_hz), 1e-3);
}

}  // namespace

std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s) {
  return local_fit(despiked(std::move(track), weights, frame_rate_hz), weights,
                   deviation_frames(frame_rate_hz, deviation_s));
}

std::vector<Vec3> smooth_path(std::vector<Vec3> path, std::span<const double> weights,
                              double frame_rate_hz, double deviation_s) {
  for (Vec3& point : path) point.y = 0;
  path = despiked(std::move(path), weights, frame_rate_hz);
  std::vector<double> x, z;
  for (const Vec3 point : path) {
    x.push_back(point.x);
    z.push_back(point.z);
  }
  const double deviation = deviation_frames(frame_rate_hz, deviation_s);
  x = local_fit(x, weights, deviation);
  z = local_fit(z, weights, deviation);
  for (std::size_t f = 0; f < path.size(); ++f) path[f] = {x[f], 0, z[f]};
  return path;
}

void continue_angles(std::span<double> angles, std::span<const double> weights) {
  bool started = false;
  double steady = 0, previous = 0;
  int frames_away = 0;
  for (std::size_t f = 0; f < angles.size(); ++f) {
    if (!(weights[f] > 0)) continue;
    if (!started) {
      steady = previous = angles[f];
      started = true;
      continue;
    }
    const double from_steady = wrap_angle(angles[f] - steady, pi);
    const double from_previous = wrap_angle(angles[f] - previous, pi);
    angles[f] = std::fabs(from_steady) < std::fabs(from_previous) ? steady + from_steady
                                                                  : previous + from_previous;
    previous = angles[f];
    if (std::fabs(previous - steady) < steady_rad || ++frames_away > patience_frames) {
      steady = previous;
      frames_away = 0;
    }
  }
}

}  // namespace kinemend::representation
