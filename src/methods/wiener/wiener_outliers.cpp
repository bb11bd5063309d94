// Filters the take repeatedly and bridges the samples that lie far from the result.
#include "methods/wiener/wiener_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantiles.hpp"
#include "kinemend/experimental/signal.hpp"
#include "signal/fourth_difference.hpp"

namespace kinemend {

namespace {

// Passes (ablation_wiener.csv: "one pass over dense ones"); median deviations, and degrees, from
// which a sample is an outlier.
constexpr int passes = 2;
constexpr double outlier_deviations = 4;
constexpr double least_outlier_deg = 1;

bool is_observed(const WienerTake& take, std::size_t sample) {
  return take.observed.empty() || take.observed[sample] != 0;
}

// D: noise, outliers included.
std::vector<double> noise_with_outliers(const WienerTake& take) {
  const PoseMatrix& y = take.poses;
  std::vector<double> noise(take.noise.begin(), take.noise.end());
  for (std::size_t d = 0; d < y.channels; ++d) {
    double sum = 0, count = 0;
    std::size_t run = 0;
    for (std::size_t f = 0; f < y.frames; ++f) {
      run = is_observed(take, f * y.channels + d) ? run + 1 : 0;
      if (run <= signal::fourth_difference_span) continue;
      const double difference = signal::fourth_difference(y, f, d);
      sum += difference * difference / signal::fourth_difference_variance;
      count += 1;
    }
    if (count > 0) noise[d] = std::max(noise[d], std::sqrt(sum / count));
  }
  return noise;
}

// Marks samples far from the estimate, and sets the noise to that of the other samples.
void judge(const WienerTake& take, const PoseMatrix& estimate, std::vector<std::uint8_t>& suspect,
           std::vector<double>& noise) {
  const std::size_t channels = estimate.channels;
  std::fill(suspect.begin(), suspect.end(), std::uint8_t{0});
  for (std::size_t d = 0; d < channels; ++d) {
    const auto distance = [&](std::size_t f) {
      return std::abs(take.poses(f, d) - estimate(f, d));
    };
    std::vector<double> distances;
    for (std::size_t f = 0; f < estimate.frames; ++f) {
      if (is_observed(take, f * channels + d)) distances.push_back(distance(f));
    }
    const double limit = std::max(
        least_outlier_deg, outlier_deviations * deviations_per_median * median_of(distances));
    double sum = 0, count = 0;
    const std::size_t first = d - d % 3, last = std::min(first + 3, channels);
    for (std::size_t f = 0; f < estimate.frames; ++f) {
      if (!is_observed(take, f * channels + d)) continue;
      if (distance(f) > limit) {
        for (std::size_t c = first; c < last; ++c)
          suspect[f * channels + c] = is_observed(take, f * channels + c) ? 1 : 0;
      } else {
        sum += distance(f) * distance(f);
        count += 1;
      }
    }
    if (count > 0) noise[d] = std::clamp(std::sqrt(sum / count), take.noise[d], noise[d]);
  }
}

// Replaces suspects by splines through the other samples.
void bridge(const WienerTake& take, const std::vector<std::uint8_t>& suspect, PoseMatrix& guess) {
  std::vector<std::uint8_t> missing = suspect;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (!is_observed(take, i)) missing[i] = 1;
  }
  PoseMatrix bridged = take.poses;
  fill_cubic(bridged, missing);
  for (std::size_t i = 0; i < suspect.size(); ++i) {
    if (suspect[i] != 0) guess.values[i] = bridged.values[i];
  }
}

}  // namespace

WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take) {
  WienerOutliers result{{take.suspect.begin(), take.suspect.end()}, take.guess};
  result.suspect.resize(take.poses.values.size(), 0);
  WienerSettings settings;
  settings.rounds = 1;
  // The set of suspects is fixed.
  settings.least_outlier_deg = std::numeric_limits<double>::max();
  std::vector<double> noise = noise_with_outliers(take);
  for (int pass = 0; pass < passes; ++pass) {
    PoseMatrix estimate =
        wiener_filter(
            prior, {take.poses, result.guess, take.observed, result.suspect, noise, take.rate_hz},
            settings)
            .poses;
    judge(take, estimate, result.suspect, noise);
    result.guess = std::move(estimate);
    bridge(take, result.suspect, result.guess);
  }
  return result;
}

}  // namespace kinemend
