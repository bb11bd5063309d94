#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fill/samples.hpp"

namespace kinemend::fill {

/// Carries the errors that a guess has at the observed frames beside a gap into the gap, so that
/// the corrected guess meets both ends in value and velocity: the mean of a Gaussian process
/// through these errors (Rasmussen & Williams 2006, eq. 2.23). Its covariance is Matern's with nu =
/// 5/2, twice differentiable; far from both ends the guess is left as it is.
class Bridge {
 public:
  /// `beside`: observed frames next to the span, ascending, at least one; `wanted`: the frames of
  /// the span that are asked for; `memory_s`: the time after which errors are forgotten.
  Bridge(std::span<const std::size_t> beside, std::span<const std::size_t> wanted,
         double memory_frames);

  /// The errors (sample less guess) at `wanted`, from those at `beside`.
  std::vector<Vec3> carry(std::span<const Vec3> errors) const;

 private:
  std::size_t beside_;
  std::vector<double> weights_;  // wanted x beside
};

}  // namespace kinemend::fill
