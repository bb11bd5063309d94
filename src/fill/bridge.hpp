// Carries the errors that a guess has beside a gap into the gap so that the guess meets both ends.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fill/samples.hpp"

namespace kinemend::fill {

/// Carries the errors of a guess at the observed frames beside a gap into the gap, so that the
/// corrected guess meets both ends in value and velocity. The correction is the mean of a Gaussian
/// process through these errors (Rasmussen & Williams 2006, eq. 2.23). Most of a pose guess's error
/// has lasted for a while, so the process is a sum of two: a fast one with Matern's covariance of
/// nu = 5/2 and the given memory, and a slower one of nu = 3/2. Far from both ends the guess is
/// left unchanged.
class Bridge {
 public:
  struct Settings {
    double memory_s = 0.083;  ///< memory of the fast part
    /// Variance of the samples' noise as a share of the errors' variance. The samples next to the
    /// gap are met whatever its value.
    double noise = 1e-4;
  };

  /// `beside`: observed frames next to the span, ascending. `wanted`: the requested frames of the
  /// span.
  Bridge(std::span<const std::size_t> beside, FrameSpan span, std::span<const std::size_t> wanted,
         double frame_rate_hz, const Settings& settings);

  /// Returns the errors (sample minus guess) at `wanted`, given those at `beside`.
  std::vector<Vec3> carry(std::span<const Vec3> errors) const;

 private:
  std::size_t wanted_, beside_;
  std::vector<double> weights_;  // wanted x beside
};

}  // namespace kinemend::fill
