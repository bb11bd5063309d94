// Detects outliers that are so dense that a filter takes them for noise.
#pragma once

#include <cstdint>
#include <vector>

#include "learned/wiener/wiener_filter.hpp"

namespace kinemend {

struct WienerOutliers {
  std::vector<std::uint8_t>
      suspect;       ///< F x D, 1 for outliers; shared by the three channels of a track
  PoseMatrix guess;  ///< F x D, for samples that are missing or suspect
};

/// Detects dense outliers, a tenth of the samples and more: the take is filtered as if outliers
/// were noise, of the variance of its fourth differences; samples far from the result, relative to
/// the median distance, are bridged; and this is repeated with the remaining noise. Starts from
/// `take.suspect` and `take.guess`.
WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take);

}  // namespace kinemend
