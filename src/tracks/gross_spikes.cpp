#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"
#include "tracks/spikes.hpp"

namespace kinemend {

namespace {

constexpr double clear_ratio = 6;  // to the deviations about a sample
constexpr double clear_deviation = 6 * radians_per_degree;
constexpr std::size_t reach = 8;  // frames on either side that say what is usual

Quat middle(Quat a, Quat b) {
  const Quat sum = a + align_hemisphere(b, a);
  return norm(sum) > 1e-9 ? normalized(sum) : a;
}

// Distance of the first of five samples from the lines through three of the next four, the least of
// them: one spike among those does no harm. `at(k)` is the k-th sample from the end.
template <class At>
double end_deviation(const At& at) {
  // Value at 0 of the straight line through samples at 1, 2, 3; at 2, 3, 4; and at 1, 3, 4, by
  // least squares.
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
    result[t] = angle_between(middle(track[t - 1], track[t + 1]), track[t]);
  result[0] = end_deviation([&](std::size_t k) { return track[k]; });
  result[last] = end_deviation([&](std::size_t k) { return track[last - k]; });
  return result;
}

double median_within(const std::vector<double>& values, std::size_t first, std::size_t last) {
  std::vector<double> part(values.begin() + static_cast<std::ptrdiff_t>(first),
                           values.begin() + static_cast<std::ptrdiff_t>(last));
  return upper_median_of(part);
}

bool is_clear_peak(const std::vector<double>& deviation, std::size_t t, double usual) {
  const std::size_t frames = deviation.size();
  if (deviation[t] <= std::max(clear_ratio * usual, clear_deviation)) return false;
  for (std::size_t k = t < 2 ? 0 : t - 2; k < std::min(t + 3, frames); ++k) {
    if (deviation[k] > deviation[t]) return false;
  }
  const std::size_t first = t < reach ? 0 : t - reach, last = std::min(t + reach + 1, frames);
  return deviation[t] > clear_ratio * median_within(deviation, first, last);
}

}  // namespace

std::vector<std::uint8_t> replace_gross_spikes(std::vector<Quat>& track) {
  const std::size_t frames = track.size();
  std::vector<std::uint8_t> marks(frames);
  if (frames < 5) return marks;
  for (int pass = 0; pass < 4; ++pass) {
    const std::vector<double> deviation = deviations(track);
    const double usual = median_within(deviation, 1, deviation.size() - 1);
    std::vector<std::size_t> peaks;
    for (std::size_t t = 0; t < frames; ++t) {
      if (is_clear_peak(deviation, t, usual)) peaks.push_back(t);
    }
    if (peaks.empty()) break;
    std::vector<Quat> replaced = track;
    for (const std::size_t t : peaks) {
      marks[t] = 1;
      replaced[t] = t == 0            ? track[1]
                    : t == frames - 1 ? track[frames - 2]
                                      : middle(track[t - 1], track[t + 1]);
    }
    track = std::move(replaced);
  }
  return marks;
}

}  // namespace kinemend
