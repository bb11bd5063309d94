// The distance of a sequence from the learned patterns, as a quadratic form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "nn/gemm.hpp"
#include "papers/lou2010_example/pattern_convolution.hpp"
#include "papers/lou2010_example/window_bases.hpp"

namespace kinemend {

/// Distance of a sequence from the patterns of all sliding windows (second term of eq. 11) for the
/// best coefficients c_s (eq. 13), a quadratic form of the sequence:
///
///   sum_s min_c sum (d_l (z_s - E c)_l)^2 + sum_k v_k c_k^2 = z^T (D - A) z
///
/// with D diagonal and A = sum_s P_s^T G G^T P_s, where P_s extracts window s from the sequence.
class PatternPenalty {
 public:
  /// How A is applied. Both agree to rounding.
  enum class Product : std::uint8_t {
    quicker,     ///< the faster of the two
    windows,     ///< G^T, then G, of all windows: matrices that read overlapping windows in place
    frequencies  ///< PatternConvolution, less the windows that wrap around the end
  };
  // Interpolated bases use a third method: each window is brought to the model's frames, where G is
  // small, and back.

  /// `weights`: d_l^2 of each channel, >= 0. `ridge`: v_k of each base, >= 0; empty: none.
  /// `frames`: of the sequence, at least `bases.frames`. `products`: expected number of products
  /// with A, which decides the faster method. `product` is ignored for interpolated bases.
  PatternPenalty(WindowBases bases, std::span<const double> weights, std::span<const double> ridge,
                 std::size_t frames, std::size_t products = 1, Product product = Product::quicker);

  /// Frames of the sequences that it takes: `frames`, padded to whole hops. The windows cover all
  /// frames of the clip; the padding is ignored.
  std::size_t padded_frames() const noexcept { return groups_ * hop_; }
  std::size_t windows() const noexcept { return windows_; }
  bool goes_by_frequencies() const noexcept { return convolution_.has_value(); }
  /// D for a frame (below padded_frames) and a channel: its weight in all windows over it.
  double diagonal(std::size_t frame, std::size_t channel) const {
    return windows_over_[frame] * weights_[channel];
  }
  /// image = A z; both padded_frames x L.
  void multiply(const PoseMatrix& z, PoseMatrix& image);

 private:
  bool frequencies_are_quicker(std::size_t products) const;
  void prepare_windows(const std::vector<double>& factor);
  void multiply_windows(const PoseMatrix& z, PoseMatrix& image);
  void multiply_at_model_rate(const PoseMatrix& z, PoseMatrix& image);
  void multiply_ends(const PoseMatrix& z);
  void take_off_ends(PoseMatrix& image) const;

  std::size_t hop_, channels_, count_;
  std::size_t row_values_;  // M' L
  std::size_t overlap_;     // hops in a window
  std::size_t windows_, groups_;
  std::vector<double> coefficients_;  // of all windows, with overlap - 1 rows of zeros at each
                                      // end; or of windows beyond the end, K x (overlap - 1)
  // By windows: G and, for each hop, overlap K x hop L.
  nn::PackedMatrix analysis_, synthesis_;
  // By frequencies: all windows of the periodic take, and G, M' L x K, for those that wrap around
  // its end (padded with zeros to whole hops).
  std::optional<PatternConvolution> convolution_;
  std::vector<double> factor_;
  std::vector<double> ends_, windows_over_end_;
  // At the model's frames: the interpolation, M' x M, padded with zeros to whole hops; G is
  // `factor_`, M L x K; and the windows, M x L each, between overlap - 1 windows of zeros.
  std::vector<double> interpolation_, at_model_rate_;
  std::size_t model_frames_ = 0;
  std::vector<double> windows_over_;  // each frame
  std::vector<double> weights_;       // d_l^2
};

}  // namespace kinemend
