// The bilateral filter of Courty 2008 on one track of rotations or positions.
#pragma once

#include <cstddef>
#include <vector>

#include "cleaner/pieces.hpp"

namespace kinemend {

/// The weights of one pass of the bilateral filter (Courty 2008, section 4).
struct BilateralKernel {
  /// W_t: exp(-r^2 / (2 sigma_t^2)) for r = 0 .. k.
  std::vector<double> temporal_weights;
  /// 1 / (2 sigma_g^2): W_g = exp(-d^2 / (2 sigma_g^2)), d in radians or the positions' unit.
  double distance_scale = 0;

  std::size_t half_width() const { return temporal_weights.size() - 1; }
};

/// Weights up to where they fall to 1 percent: k = 3 sigma_t, rounded, at least 1.
BilateralKernel bilateral_kernel(double sigma_t_frames, double sigma_g);

/// Extension of a signal beyond its first and last sample.
enum class BilateralEnds {
  mirror,  ///< x_-i = x_i
  reflect  ///< x_-i = x_0 - (x_i - x_0), on rotations q_0 q_i^-1 q_0: a steady turn continues
};

/// Filters in place, `passes` times, the signal extended at its ends in each pass. Samples of
/// weight 0 are ignored in the windows of others; without weights all are 1.
void bilateral_filter(RotationTrack& track, const std::vector<double>& sample_weights,
                      const BilateralKernel& kernel, std::size_t passes, BilateralEnds ends);
void bilateral_filter(VectorTrack& track, const std::vector<double>& sample_weights,
                      const BilateralKernel& kernel, std::size_t passes, BilateralEnds ends);

}  // namespace kinemend
