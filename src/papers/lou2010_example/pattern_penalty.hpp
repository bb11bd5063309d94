// Measures the distance of a sequence from the learned patterns, a quadratic form, window by window
// or by frequencies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "nn/gemm.hpp"
#include "papers/lou2010_example/filter_bases.hpp"

namespace kinemend {

/// The product with A = sum_s P_s^T G G^T P_s of a periodic sequence, whose windows wrap around its
/// end. A row of the sequence, a hop, is a vector of V values, and a window has W rows. A is then a
/// convolution in time with V x V matrices, which is one product of V x V complex matrices at each
/// frequency. This is less work than two products with all of G if G has many columns, and
/// independent of their number.
///
/// Blocks of rows overlap by the convolution's length (overlap-save), so that work is linear in the
/// sequence's length. Fourier transforms of so few rows are products of matrices, too: one for the
/// rows' even component about the middle of the block and one for the odd.
///
/// Matrices of more than `most_exact_bytes` are kept in single precision, the precision of their
/// bases: the product then has a relative error of 1e-6.
class PatternConvolution {
 public:
  /// `patterns`: G, row-major, W V rows and K columns.
  PatternConvolution(const std::vector<double>& patterns, std::size_t window_rows,
                     std::size_t row_values, std::size_t count);

  // Limits memory; not swept.
  static constexpr std::size_t most_exact_bytes = std::size_t{1} << 24;

  /// image = A z; both `rows` x V, row-major.
  void multiply(const double* z, std::size_t rows, double* image);

  /// Multiply-adds of doubles that `multiply` needs for this number of rows, and that the
  /// constructor needs.
  static double work(std::size_t rows, std::size_t window_rows, std::size_t row_values);
  static double preparation(std::size_t window_rows, std::size_t row_values, std::size_t count);

 private:
  void prepare_transforms();
  // Prepares frequencies [first, last); `scratch` is overwritten.
  void prepare_matrices(const std::vector<double>& patterns, std::size_t count, std::size_t first,
                        std::size_t last, std::vector<double>& scratch);
  bool is_narrow() const;
  // Transforms blocks [first, last) of those that are transformed at once.
  void transform(const double* z, std::size_t rows, std::size_t first, std::size_t last);
  void filter(std::size_t frequency);
  void transform_back(double* image, std::size_t rows, std::size_t first, std::size_t last);

  std::size_t row_values_;   // V
  std::size_t reach_;        // W - 1: rows to each side that a row of the image depends on
  std::size_t block_rows_;   // odd, so that a block has a middle and only frequency 0 is real
  std::size_t frequencies_;  // (block_rows + 1) / 2
  std::size_t fresh_rows_;   // rows of the image that a block gives, odd
  // Blocks that are transformed at once, and the first of them.
  std::size_t first_block_ = 0, blocks_ = 0;
  // Cosines and -sines at the frequencies and at times 0, 1, ... from the middle of a block.
  std::vector<double> cosines_, sines_;
  std::vector<double> cosines_back_, sines_back_;  // times x frequencies
  std::vector<nn::PackedMatrix> matrices_;         // of each frequency [Re Im], V x 2 V
  std::vector<std::vector<float>> narrow_;         // the same if they are large
  std::vector<double> spectrum_;                   // frequencies x (real, imaginary) x blocks x V
};

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
