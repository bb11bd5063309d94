// Replaces spikes that are so large that they would bend the reference of a track's chart.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"
#include "methods/auto/spikes.hpp"

namespace kinemend {

namespace {

Quat mean_of(Quat a, Quat b) {
  const Quat sum = a + align_hemisphere(b, a);
  return norm(sum) > 1e-9 ? normalized(sum) : a;
}

// Smallest distance of the first of five samples from lines through three of the next four; one
// spike among those four hardly changes it. `at(k)` is the k-th sample from the end.
template <class At>
double end_deviation(const At& at) {
  // Value at 0 of the least-squares line through samples at 1, 2, 3; at 2, 3, 4; and at 1, 3, 4.
  struct Line {
    std::array<std::size_t, 3> samples;
    std::array<double, 3> weights;
  };
  static constexpr Line lines[] = {{{1, 2, 3}, {4.0 / 3, 1.0 / 3, -2.0 / 3}},
                                   {{2, 3, 4}, {11.0 / 6, 1.0 / 3, -7.0 / 6}},
                                   {{1, 3, 4}, {9.0 / 7, 1.0 / 7, -3.0 / 7}}};
  double least = pi;
  for (const Line& line : lines) {
    const Quat base = at(line.samples[0]);
    Vec3 sum;
    for (std::size_t i = 1; i < 3; ++i)
      sum += line.weights[i] * log(conjugate(base) * at(line.samples[i]));
    least = std::min(least, angle_between(base * exp(sum), at(0)));
  }
  return least;
}

std::vector<double> deviations(const std::vector<Quat>& track) {
  const std::size_t last = track.size() - 1;
  std::vector<double> result(track.size());
  for (std::size_t t = 1; t < last; ++t)
    result[t] = angle_between(mean_of(track[t - 1], track[t + 1]), track[t]);
  result[0] = end_deviation([&](std::size_t k) { return track[k]; });
  result[last] = end_deviation([&](std::size_t k) { return track[last - k]; });
  return result;
}

double median_within(const std::vector<double>& values, std::size_t first, std::size_t last) {
  std::vector<double> window(values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(last));
  return upper_median_of(window);
}

bool is_gross_spike(const std::vector<double>& deviation, std::size_t t, double median,
                    const GrossSpikeTuning& tuning) {
  const std::size_t frames = deviation.size();
  if (deviation[t] <= std::max(tuning.ratio * median, tuning.least_deg * radians_per_degree))
    return false;
  for (std::size_t k = t < 2 ? 0 : t - 2; k < std::min(t + 3, frames); ++k) {
    if (deviation[k] > deviation[t]) return false;
  }
  const std::size_t reach = tuning.window_frames;
  const std::size_t first = t < reach ? 0 : t - reach, last = std::min(t + reach + 1, frames);
  return deviation[t] > tuning.ratio * median_within(deviation, first, last);
}

}  // namespace

std::vector<std::uint8_t> replace_gross_spikes(std::vector<Quat>& track,
                                               const GrossSpikeTuning& tuning) {
  const std::size_t frames = track.size();
  std::vector<std::uint8_t> marks(frames);
  if (frames < 5) return marks;
  for (int pass = 0; pass < tuning.passes; ++pass) {
    const std::vector<double> deviation = deviations(track);
    const double median = median_within(deviation, 1, deviation.size() - 1);
    std::vector<std::size_t> peaks;
    for (std::size_t t = 0; t < frames; ++t) {
      if (is_gross_spike(deviation, t, median, tuning)) peaks.push_back(t);
    }
    if (peaks.empty()) break;
    std::vector<Quat> replaced = track;
    for (const std::size_t t : peaks) {
      marks[t] = 1;
      replaced[t] = t == 0            ? track[1]
                    : t == frames - 1 ? track[frames - 2]
                                      : mean_of(track[t - 1], track[t + 1]);
    }
    track = std::move(replaced);
  }
  return marks;
}

}  // namespace kinemend
