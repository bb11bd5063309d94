// Computes the posterior mean of a take under the prior of `wiener`, window by window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "methods/wiener/wiener_prior.hpp"

namespace kinemend {

struct WienerSettings {
  /// How often samples are judged again, and those without weight estimated again.
  std::size_t rounds = 2;
  /// Standard deviations beyond which a sample gets no weight; 0 keeps all.
  double outlier_deviations = 4.5;
  double least_outlier_deg = 1;  ///< samples at a smaller distance are not outliers
};

struct WienerTake {
  const PoseMatrix& poses;                 ///< F x D
  const PoseMatrix& guess;                 ///< F x D, for samples that are missing or suspect
  std::span<const std::uint8_t> observed;  ///< F x D; empty: all
  std::span<const std::uint8_t> suspect;   ///< F x D, 1: initial outliers; empty: none
  std::span<const double> noise;           ///< D, positive: standard deviations, degrees
  double rate_hz = 120;
};

struct WienerResult {
  PoseMatrix poses;                    ///< the posterior means
  std::vector<std::uint8_t> rejected;  ///< F x D, 1 where an observed sample had no weight
};

/// The posterior mean of a take, window by window and overlap-added. Components are weighted by the
/// evidence of each window. The residual is shrunk by its own spectrum (`RestModel`). A sample far
/// from its window's estimate is rejected, and stays so. Each estimate replaces missing and
/// rejected samples. Channels come in threes, which share outliers.
WienerResult wiener_filter(const WienerPrior& prior, const WienerTake& take,
                           const WienerSettings& settings = {});

}  // namespace kinemend
