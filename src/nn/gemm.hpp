#pragma once

#include <cstddef>

/// Products of dense matrices of doubles.
namespace kinemend::nn {

/// Element (r, c) is values[r * row_stride + c * column_stride]. Rows may overlap: with
/// `row_stride` less than `columns` a frame-major sequence is its own trajectory matrix.
struct MatrixView {
  const double* values = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t row_stride = 0;
  std::size_t column_stride = 1;

  MatrixView transposed() const { return {values, columns, rows, column_stride, row_stride}; }
};

/// Rows are contiguous and do not overlap.
struct MutableMatrixView {
  double* values = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t row_stride = 0;
};

enum class Product { overwrite, add };

/// c = a b, or c += a b. Shapes match; c overlaps neither a nor b. `a` is read in place, so that
/// views of overlapping rows cost nothing; `b` is copied block by block. Each element is summed in
/// the same order on every processor and with any number of threads, without fused multiply-add.
void multiply(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
              Product product = Product::overwrite);

}  // namespace kinemend::nn
