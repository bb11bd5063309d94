// Estimates the white noise of a track from its second differences, and measures peak speeds of two
// versions of a track, in radians or the points' unit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// Returns the standard deviation per axis of the white noise on a track (radians; the points'
/// unit), from the median length of its second differences: motion hardly bends within three
/// frames, and outliers do not affect a median. Uses at most `most_samples`, evenly spread. Returns
/// 0 for fewer than 3 samples.
double track_noise(std::span<const Quat> track, std::size_t most_samples = 4096);
double track_noise(std::span<const Vec3> track, std::size_t most_samples = 4096);

/// Returns the length of the second difference of three successive samples (radians or the points'
/// unit).
double second_difference(Quat a, Quat b, Quat c);
double second_difference(Vec3 a, Vec3 b, Vec3 c);
/// Noise per axis divided by the median second difference. By definition: the root of 1 + 4 + 1.
inline constexpr double noise_per_second_difference = 1 / (median_of_chi3 * 2.449489742783178);

/// The noise of a track's samples along each axis.
struct SampleNoise {
  double white = 0;        ///< strength of the white noise that has the same highest frequencies
  double strength = 0;     ///< total strength
  double correlation = 0;  ///< from one frame to the next

  /// Returns the standard deviation of the difference of two samples `frames` apart.
  double of_difference(std::size_t frames) const {
    return strength * std::sqrt(2 * (1 - portable::pow(correlation, static_cast<double>(frames))));
  }
};

struct Peaks {
  double before = 0;  ///< speed, per second
  double after = 0;
  std::size_t frames = 1;  ///< the step over which they are measured
  double noise = 0;        ///< by how much noise may have raised `before`
};

/// Returns the probable length of the longest of `count` vectors of white noise with a standard
/// deviation of 1 along each of three axes: one in twenty such sets has a longer one.
inline double longest_of_noise(std::size_t count) {
  // One in twenty, by definition.
  constexpr double chance = 0.05;
  const double expected = static_cast<double>(std::max<std::size_t>(count, 1)) / chance;
  // P(length > r) = sqrt(2 / pi) r exp(-r^2 / 2) where r is large.
  double length = 4;
  for (int i = 0; i < 4; ++i)
    length = std::sqrt(2 * portable::log(expected * std::sqrt(2 / pi) * length));
  return length;
}

namespace peaks {

inline double between(Quat a, Quat b) { return angle_between(a, b); }
inline double between(Vec3 a, Vec3 b) { return norm(a - b); }
/// A cheap number that grows with the distance.
inline double order_of_distance(Quat a, Quat b) { return -std::fabs(dot(a, b)); }
inline double order_of_distance(Vec3 a, Vec3 b) { return dot(a - b, a - b); }

/// Marks samples that lie far off the path of their neighbours. A person cannot move out and back
/// within two frames, and a spike that the method left is not a peak.
template <class Sample>
void leave_out_spikes(const std::vector<Sample>& track, double noise,
                      std::vector<std::uint8_t>& left_out) {
  // The limits in deviations of the noise, and as a detour relative to the direct distance. Chosen
  // by hand, not swept.
  constexpr double clear_noise = 8, clear_detour = 3;
  for (std::size_t f = 1; f + 1 < track.size(); ++f) {
    if (second_difference(track[f - 1], track[f], track[f + 1]) < 2 * clear_noise * noise) continue;
    const double step = std::min(between(track[f - 1], track[f]), between(track[f], track[f + 1]));
    const double past = between(track[f - 1], track[f + 1]);
    if (step > clear_noise * noise && step > clear_detour * past) left_out[f] = 1;
  }
}

/// Returns the largest distance within `gap` frames as a speed; negative if there is no pair.
/// `left_out` marks ignored samples.
template <class Sample>
double peak_speed(const std::vector<Sample>& track, const std::vector<std::uint8_t>& left_out,
                  std::size_t gap, double rate_hz) {
  bool found = false;
  double largest = 0;
  std::size_t at = 0;
  for (std::size_t f = 0; f + gap < track.size(); ++f) {
    if (left_out[f] || left_out[f + gap]) continue;
    const double order = order_of_distance(track[f], track[f + gap]);
    if (!found || order > largest) largest = order, at = f, found = true;
  }
  if (!found) return -1;
  return between(track[at], track[at + gap]) * rate_hz / static_cast<double>(gap);
}

}  // namespace peaks

/// Returns the peaks of a track with this noise. `left_out` marks ignored samples; spikes are also
/// ignored. Peaks are measured over the shortest step (one frame to 50 ms) in which noise adds less
/// than a tenth.
template <class Sample>
Peaks measure_peaks(const std::vector<Sample>& before, const std::vector<Sample>& after,
                    std::vector<std::uint8_t> left_out, const SampleNoise& noise, double rate_hz) {
  // The window of a peak, and the largest share of it that noise may have. Chosen by hand, not
  // swept.
  constexpr double longest_s = 0.05;
  constexpr double noise_share = 0.1;
  const double longest = longest_of_noise(before.size());
  peaks::leave_out_spikes(before, noise.white, left_out);
  const auto most =
      static_cast<std::size_t>(std::max(1.0, std::round(longest_s * window_rate_hz(rate_hz))));
  Peaks result;
  for (std::size_t gap = 1; gap <= most; ++gap) {
    const double peak = peaks::peak_speed(before, left_out, gap, rate_hz);
    if (peak < 0) break;
    result.before = peak;
    result.frames = gap;
    result.noise = longest * noise.of_difference(gap) * rate_hz / static_cast<double>(gap);
    if (result.noise <= noise_share * peak) break;
  }
  result.after = std::max(0.0, peaks::peak_speed(after, left_out, result.frames, rate_hz));
  return result;
}

}  // namespace kinemend
