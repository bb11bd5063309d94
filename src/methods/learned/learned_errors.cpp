// Sums what was removed and what is expected to remain, for each track and for a take.
#include "methods/learned/learned_errors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track) {
  const std::size_t later = frames_of_quick_noise(take.frame_rate_hz);
  TrackError error;
  const auto change = [&](std::size_t i) {
    return static_cast<double>(result.values[i] - take.values[i]);
  };
  double samples = 0;  // samples of moving axes
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      const std::size_t i = f * take.channels + c;
      if (result.deviation[i] == 0 && change(i) == 0) continue;
      samples += 1;
      error.removed += change(i) * change(i);
      error.left += static_cast<double>(result.deviation[i]) * result.deviation[i];
      if (f < later) continue;
      const double difference = change(i) - change(i - later * take.channels);
      error.quick += 0.5 * difference * difference;
    }
  }
  samples = std::max(samples, 1.0);
  error.removed /= samples, error.left /= samples, error.quick /= samples;
  if (error.removed > error.quick)
    error.correlation =
        portable::pow(1 - error.quick / error.removed, 1 / static_cast<double>(later));
  return error;
}

bool is_worth_a_change(const TrackError& error) {
  // Smallest ratio of the removed deviation to the remaining one. Chosen by hand
  // (docs/methods/learned.md), not swept.
  constexpr double least_share = 0.1;
  return error.removed > least_share * least_share * error.left;
}

ColouredNoise removed_noise(std::span<const TrackError> errors) {
  std::vector<double> strengths, correlations;
  for (const TrackError& error : errors) {
    if (!is_worth_a_change(error)) continue;
    strengths.push_back(std::sqrt(error.removed));
    correlations.push_back(error.correlation);
  }
  if (strengths.empty()) return {};
  return {median_of(strengths), median_of(correlations)};
}

double slow_noise(std::span<const TrackError> errors) {
  // Smallest reported noise, degrees, and the largest share of its variance that changes within 40
  // ms. Chosen by hand, not swept.
  constexpr double least_deg = 1, most_quick_share = 0.25;
  std::vector<double> sizes, quick;
  for (const TrackError& error : errors) {
    if (error.left == 0 || !is_worth_a_change(error)) continue;
    sizes.push_back(std::sqrt(error.all()));
    quick.push_back(error.quick / error.all());
  }
  if (sizes.empty()) return 0;
  const double size = median_of(sizes);
  return size >= least_deg && median_of(quick) <= most_quick_share ? size : 0;
}

}  // namespace kinemend
