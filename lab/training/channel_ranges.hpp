// Collects the values of channels over many takes and finds their quantiles.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/extend/frames.hpp"

namespace kinemend {

/// Histogram of the values of each channel, in degrees: memory does not depend on their number.
class ChannelRanges {
 public:
  explicit ChannelRanges(std::size_t channels);

  void add(const PoseMatrix& poses, double weight = 1);
  /// The value that `share` (0..1) of the channel's values do not exceed, to a quarter degree and
  /// within +-720 degrees; 0 for a channel without values.
  double quantile(std::size_t channel, double share) const;

 private:
  std::size_t channels_;
  std::vector<double> counts_;  // channels x bins
};

}  // namespace kinemend
