// Products of dense matrices, in double and (with the suffix F) in single precision.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kinemend::nn {

/// Element (r, c) is values[r * row_stride + c * column_stride]. Rows may overlap: with
/// `row_stride` less than `columns` a frame-major sequence is its own trajectory matrix.
template <class Real>
struct BasicMatrixView {
  const Real* values = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t row_stride = 0;
  std::size_t column_stride = 1;

  /// The part of the given size that starts at a row and column.
  BasicMatrixView block(std::size_t row, std::size_t column, std::size_t row_count,
                        std::size_t column_count) const {
    return {values + row * row_stride + column * column_stride, row_count, column_count, row_stride,
            column_stride};
  }
  BasicMatrixView transposed() const { return {values, columns, rows, column_stride, row_stride}; }
};
using MatrixView = BasicMatrixView<double>;
using MatrixViewF = BasicMatrixView<float>;

/// Rows are contiguous and do not overlap.
template <class Real>
struct BasicMutableMatrixView {
  Real* values = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t row_stride = 0;

  BasicMutableMatrixView block(std::size_t row, std::size_t column, std::size_t row_count,
                               std::size_t column_count) const {
    return {values + row * row_stride + column, row_count, column_count, row_stride};
  }
};
using MutableMatrixView = BasicMutableMatrixView<double>;
using MutableMatrixViewF = BasicMutableMatrixView<float>;

enum class Product { overwrite, add };

/// Computes c = a b, or c += a b. Shapes must match; c overlaps neither a nor b. `a` is read in
/// place, so that views of overlapping rows cost nothing; `b` is copied block by block. Each
/// element is summed in the same order on every processor and with any number of threads, without
/// fused multiply-add, in the precision of the matrices: the error of a sum of n terms is at most
/// (n + 2) u times the sum of their sizes, u = 2^-53 or 2^-24.
void multiply(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
              Product product = Product::overwrite);
void multiply(const MatrixViewF& a, const MatrixViewF& b, const MutableMatrixViewF& c,
              Product product = Product::overwrite);

/// The same for a symmetric product a b, with about half of the work: the part of c above the
/// diagonal is copied from below it.
void multiply_symmetric(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
                        Product product = Product::overwrite);
void multiply_symmetric(const MatrixViewF& a, const MatrixViewF& b, const MutableMatrixViewF& c,
                        Product product = Product::overwrite);

/// A right factor of many products, copied once into the order in which they read it.
template <class Real>
class BasicPackedMatrix {
 public:
  BasicPackedMatrix() = default;
  explicit BasicPackedMatrix(const BasicMatrixView<Real>& b);
  /// From the `values` of another packed matrix of this shape, rounded.
  BasicPackedMatrix(std::size_t rows, std::size_t columns, std::span<const float> values);

  std::size_t rows() const noexcept { return rows_; }
  std::size_t columns() const noexcept { return columns_; }
  /// In the order in which products read them.
  std::span<const Real> values() const noexcept { return panels_; }
  /// The panels from row `first` on, a multiple of the kernel's depth.
  const Real* panels(std::size_t first) const noexcept;

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<Real> panels_;
};
using PackedMatrix = BasicPackedMatrix<double>;
using PackedMatrixF = BasicPackedMatrix<float>;

/// The same result, bit by bit, as with the matrix that was packed.
void multiply(const MatrixView& a, const PackedMatrix& b, const MutableMatrixView& c,
              Product product = Product::overwrite);
void multiply(const MatrixViewF& a, const PackedMatrixF& b, const MutableMatrixViewF& c,
              Product product = Product::overwrite);

}  // namespace kinemend::nn
