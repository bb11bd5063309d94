// Counts the values of each channel in bins of a quarter degree and reads quantiles off the counts.
#include "lab/training/channel_ranges.hpp"

#include <algorithm>
#include <numeric>

namespace kinemend {

namespace {

// Degrees: the histogram covers -720 to 720, which two turns either way do not leave. Not swept.
constexpr double farthest = 720;
constexpr double bin_width = 0.25;
constexpr std::size_t bins = 5760;

}  // namespace

ChannelRanges::ChannelRanges(std::size_t channels)
    : channels_(channels), counts_(channels * bins, 0.0) {}

void ChannelRanges::add(const PoseMatrix& poses, double weight) {
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t c = 0; c < channels_; ++c) {
      const double place = (poses(f, c) + farthest) / bin_width;
      const double bin = std::clamp(place, 0.0, static_cast<double>(bins - 1));
      counts_[c * bins + static_cast<std::size_t>(bin)] += weight;
    }
  }
}

double ChannelRanges::quantile(std::size_t channel, double share) const {
  const double* counts = &counts_[channel * bins];
  const double total = std::accumulate(counts, counts + bins, 0.0);
  if (total == 0) return 0;
  double below = 0;
  std::size_t bin = 0;
  while (bin + 1 < bins && below + counts[bin] < share * total) below += counts[bin++];
  // The first non-empty bin, where the share is 0.
  while (bin + 1 < bins && counts[bin] == 0) ++bin;
  const double fraction =
      counts[bin] > 0 ? std::clamp((share * total - below) / counts[bin], 0.0, 1.0) : 0.0;
  return (static_cast<double>(bin) + fraction) * bin_width - farthest;
}

}  // namespace kinemend
