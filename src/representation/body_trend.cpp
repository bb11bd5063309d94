#include "representation/body_trend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kinemend/rotation.hpp"

namespace kinemend::representation {

namespace {

// Samples of weight 0 on the straight line between their neighbours, held at the ends.
void bridge(std::vector<double>& track, std::span<const double> weights) {
  const std::size_t frames = track.size();
  std::size_t before = frames;  // the last known frame; `frames`: none yet
  for (std::size_t f = 0; f < frames; ++f) {
    if (!(weights[f] > 0)) continue;
    const std::size_t first = before == frames ? 0 : before + 1;
    for (std::size_t g = first; g < f; ++g) {
      const double u = before == frames
                           ? 1.0
                           : static_cast<double>(g - before) / static_cast<double>(f - before);
      track[g] = before == frames ? track[f] : track[before] + u * (track[f] - track[before]);
    }
    before = f;
  }
  if (before == frames) {
    std::fill(track.begin(), track.end(), 0.0);
  } else {
    for (std::size_t g = before + 1; g < frames; ++g) track[g] = track[before];
  }
}

double median_of(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Windows stay centred near the ends, so that a straight line stays one; the end samples follow
// Tukey's rule, so that a spike there goes too.
std::vector<double> running_median(const std::vector<double>& track, std::size_t half_window) {
  const std::size_t frames = track.size();
  std::vector<double> result(track), window;
  for (std::size_t f = 1; f + 1 < frames; ++f) {
    const std::size_t half = std::min({half_window, f, frames - 1 - f});
    const auto first = track.begin() + static_cast<std::ptrdiff_t>(f - half);
    window.assign(first, first + static_cast<std::ptrdiff_t>(2 * half + 1));
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(half);
    std::nth_element(window.begin(), middle, window.end());
    result[f] = *middle;
  }
  if (frames >= 3) {
    result.front() = median_of(track.front(), result[1], 3 * result[1] - 2 * result[2]);
    result.back() = median_of(track.back(), result[frames - 2],
                              3 * result[frames - 2] - 2 * result[frames - 3]);
  }
  return result;
}

// The value at `frame` of the line fitted to the samples around it.
double line_at(const std::vector<double>& track, std::span<const double> weights,
               const std::vector<double>& kernel, std::size_t frame) {
  const std::size_t reach = kernel.size() - 1;
  const std::size_t first = frame > reach ? frame - reach : 0;
  const std::size_t last = std::min(track.size() - 1, frame + reach);
  double s0 = 0, s1 = 0, s2 = 0, t0 = 0, t1 = 0;
  for (std::size_t g = first; g <= last; ++g) {
    const double k = static_cast<double>(g) - static_cast<double>(frame);
    const double w = weights[g] * kernel[g > frame ? g - frame : frame - g];
    s0 += w;
    s1 += w * k;
    s2 += w * k * k;
    t0 += w * track[g];
    t1 += w * k * track[g];
  }
  const double determinant = s0 * s2 - s1 * s1;
  return determinant > 1e-9 * s0 * s2 ? (s2 * t0 - s1 * t1) / determinant : t0 / s0;
}

}  // namespace

std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s) {
  if (track.empty()) return track;
  constexpr double median_s = 0.1;
  // What is bridged counts for next to nothing, but leaves no frame without any sample.
  constexpr double least_weight = 1e-4;
  bridge(track, weights);
  const auto half_window =
      static_cast<std::size_t>(std::max(2.0, std::round(0.5 * median_s * frame_rate_hz)));
  track = running_median(track, half_window);
  const double deviation = std::max(deviation_s * frame_rate_hz, 1e-3);
  std::vector<double> kernel(static_cast<std::size_t>(std::ceil(3 * deviation)) + 1);
  for (std::size_t k = 0; k < kernel.size(); ++k) {
    const double z = static_cast<double>(k) / deviation;
    kernel[k] = std::exp(-0.5 * z * z);
  }
  std::vector<double> known(weights.begin(), weights.end());
  for (double& weight : known) weight = std::max(weight, least_weight);
  std::vector<double> trend(track.size());
  for (std::size_t f = 0; f < track.size(); ++f) trend[f] = line_at(track, known, kernel, f);
  return trend;
}

void continue_angles(std::span<double> angles, std::span<const double> weights) {
  constexpr double near = pi / 3;
  constexpr int patience_frames = 12;
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
    if (std::fabs(previous - steady) < near || ++frames_away > patience_frames) {
      steady = previous;
      frames_away = 0;
    }
  }
}

}  // namespace kinemend::representation
