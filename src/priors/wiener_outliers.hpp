#pragma once

#include <cstdint>
#include <vector>

#include "priors/wiener_filter.hpp"

namespace kinemend {

struct WienerOutliers {
  std::vector<std::uint8_t> suspect;  ///< F x D, 1 for outliers; those of three channels are shared
  PoseMatrix guess;                   ///< F x D, for samples that are missing or suspect
};

/// Tells outliers that are dense, a tenth of the samples and more, by the patterns that they break:
/// the take is filtered as if outliers were noise, of the variance that its fourth differences
/// show; what is far from the result, in terms of the median distance, is bridged; and again with
/// the noise that is left. Starts from `take.suspect` and `take.guess`.
WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take);

}  // namespace kinemend
