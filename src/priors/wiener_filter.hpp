#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/pose_matrix.hpp"
#include "priors/wiener_prior.hpp"

namespace kinemend {

struct WienerSettings {
  std::size_t adaptations = 2;     ///< times that the mixture is adapted to the take
  double covariance_windows = 60;  ///< how many windows the learned covariances are worth
  double mean_windows = 5;         ///< and the learned means
  /// Standard deviations beyond which a sample counts for nothing; 0: all count.
  double outlier_deviations = 4.5;
  double least_outlier_deg = 1;  ///< nearer ones are never outliers
  double return_share = 0.75;    ///< of both limits: within it an outlier counts again
};

struct WienerTake {
  const PoseMatrix& poses;                 ///< F x D
  const PoseMatrix& guess;                 ///< F x D, for samples that are missing or suspect
  std::span<const std::uint8_t> observed;  ///< F x D; empty: all
  std::span<const std::uint8_t> suspect;   ///< F x D, 1: an outlier at first sight; empty: none
  std::span<const double> noise;           ///< D, positive: standard deviations, degrees
  double rate_hz = 120;
};

struct WienerResult {
  PoseMatrix poses;                    ///< the posterior means
  std::vector<std::uint8_t> rejected;  ///< F x D, 1 where an observed sample counted for nothing
};

/// The posterior mean of a take, window by window and overlap-added. The mixture chooses by the
/// evidence of each window; its components are then adapted to the take (maximum a posteriori,
/// `MixtureMoments::adapted`) and the windows explained anew. What the patterns leave is shrunk by
/// its own spectrum (`RestModel`). A sample far from what its window makes of it is taken out, and
/// comes back when it is near after all. Channels come in threes, of which outliers are shared.
WienerResult wiener_filter(const WienerPrior& prior, const WienerTake& take,
                           const WienerSettings& settings = {});

}  // namespace kinemend
