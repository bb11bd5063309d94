// Multiplies a sequence with the projection on the patterns of all its windows, by frequencies.
#pragma once

#include <cstddef>
#include <vector>

#include "nn/gemm.hpp"

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

}  // namespace kinemend
