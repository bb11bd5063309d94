// Whittaker smoothing: the x that minimises sum_t w[t] (y[t] - x[t])^2 + sum_t p[t] (D^d x)[t]^2,
// where D^d is the difference of order d. It is the posterior mean of a signal whose d-th
// differences are independent normal with variance 1 / p[t], measured with noise of variance 1 /
// w[t]. The banded systems are solved in O(F).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/portable.hpp"

namespace kinemend::signal {

// Channels side by side: for speed, not swept. The largest order of differences: by definition.
inline constexpr std::size_t block_channels = 8;
inline constexpr std::size_t largest_order = 3;

/// F frames of eight channels side by side, frame-major. Unused channels are zero.
struct ChannelBlock {
  std::size_t frames = 0;
  std::vector<double> values;

  explicit ChannelBlock(std::size_t frame_count, double value = 0)
      : frames(frame_count), values(frame_count * block_channels, value) {}
  double& operator()(std::size_t frame, std::size_t channel) {
    return values[frame * block_channels + channel];
  }
  double operator()(std::size_t frame, std::size_t channel) const {
    return values[frame * block_channels + channel];
  }
};

using BlockRow = std::array<double, block_channels>;

/// Binomial coefficients with alternating signs: (D^d x)[t] = sum_k c[k] x[t + k].
constexpr std::array<double, largest_order + 1> difference_coefficients(std::size_t order) {
  switch (order) {
    case 1:
      return {-1, 1, 0, 0};
    case 2:
      return {1, -2, 1, 0};
    default:
      return {-1, 3, -3, 1};
  }
}
/// The strength p / w at which the smoother passes half the amplitude at `cutoff` cycles a frame
/// (up to 1/2): (2 sin(pi cutoff))^(-2 order).
double strength_of_cutoff(double cutoff, std::size_t order);
/// The factor of a system with a larger strength loses precision. Chosen by hand, not swept.
inline constexpr double largest_strength = 1e10;

/// Cutoffs spaced by equal ratios.
struct CutoffGrid {
  double lowest_hz, highest_hz;
  std::size_t count;  ///< at least 2

  double hz(std::size_t i) const {
    return lowest_hz * portable::pow(highest_hz / lowest_hz,
                                     static_cast<double>(i) / static_cast<double>(count - 1));
  }
};

/// I + strength D^d (D^d)^T = L D L^T over the F - d differences of F frames, shared by all
/// channels whose samples have equal weights. Solving for the differences is accurate for channels
/// of any size, as differences of a slow trend are small. The matrix is Toeplitz, so the rows of
/// the factor converge, and equal ones are stored once.
struct SharedFactor {
  std::size_t frames = 0;
  std::size_t order = 1;
  double strength = 0;
  std::vector<double> lower;             ///< R x order: L[t, t - k] at t * order + k - 1
  std::vector<double> inverse_diagonal;  ///< R rows; later differences use the last one
  double log_determinant = 0;            ///< also that of I + strength (D^d)^T D^d
};
/// `order` is 1 to 3 and less than `frames`; `strength` is positive.
SharedFactor factor_shared(std::size_t frames, std::size_t order, double strength);
/// x = A^-1 y with A = I + strength (D^d)^T D^d; returns y^T (I - A^-1) y of each channel.
BlockRow solve_shared(const SharedFactor& factor, const ChannelBlock& y, ChannelBlock& x);
/// The results of `solve_shared` for each of these factors, without their solutions. Factors of one
/// order must be adjacent.
std::vector<BlockRow> shared_residuals(std::span<const SharedFactor> factors,
                                       const ChannelBlock& y);
/// The diagonal of I - A^-1, F values: the weight of all other samples in the fit of each.
std::vector<double> weights_of_others(const SharedFactor& factor);

/// diag(weight) + (D^d)^T diag(penalty) D^d for each channel, and its factor. With a coupling the
/// weight is a matrix: its row t has coupling[t - 1], weight[t], coupling[t], which is the
/// precision of noise that depends on that of the frame before.
class WeightedSystem {
 public:
  /// `order` is 1 to 3 and less than `frames`. `coupling`: F rows, which must outlive the system;
  /// nullptr: none.
  WeightedSystem(std::size_t frames, std::size_t order, const ChannelBlock* coupling = nullptr);

  /// `weight`: F rows, not negative, at least `order` of them positive; `penalty`: F - order rows,
  /// positive.
  void factor(const ChannelBlock& weight, const ChannelBlock& penalty);
  /// Sets `x` to A^-1 (weight y) by one step of iterative refinement from any initial values: it
  /// adds A^-1 (weight (y - x) - (D^d)^T penalty D^d x), whose rounding error is relative to the
  /// error of `x`. `scratch`: F rows.
  void refine(const ChannelBlock& weight, const ChannelBlock& penalty, const ChannelBlock& y,
              ChannelBlock& x, ChannelBlock& scratch);
  /// The posterior variance of each difference, diag(D^d A^-1 (D^d)^T): F - order rows.
  void difference_variances(ChannelBlock& variances);
  /// The logarithm of each channel's determinant.
  BlockRow log_determinants() const;

 private:
  std::size_t frames_;
  const double* coupling_;
  std::vector<double> diagonal_;            // F x 8
  std::vector<std::vector<double>> lower_;  // order of F x 8: L[t, t - k]
};

}  // namespace kinemend::signal
