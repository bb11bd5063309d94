// Packs panels of the second matrix and shares the rows of a product among threads.
#include "nn/gemm.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "base/parallel.hpp"
#include "nn/kernels.hpp"

namespace kinemend::nn {

namespace {

// Below this number of multiply-adds, threads cost more than they gain. For speed, not swept.
constexpr std::size_t least_parallel_products = std::size_t{1} << 21;
constexpr std::size_t rows_per_task = 32;
// Columns of a symmetric product that are computed at once, from the diagonal down: two panels of
// the widest vectors.
template <class Real>
// For speed, not swept.
constexpr std::size_t symmetric_columns = 48 * sizeof(double) / sizeof(Real);

template <class Real>
std::size_t packed_columns(std::size_t columns) {
  const std::size_t panel = gemm_panel_columns<Real>();
  return (columns + panel - 1) / panel * panel;
}

// Adds the contribution of rows [first, first + depth) of b, packed, to c.
template <class Real>
void multiply_packed(const BasicMatrixView<Real>& a, std::size_t first, std::size_t depth,
                     const Real* packed, const BasicMutableMatrixView<Real>& c, Product product) {
  const auto rows = [&](std::size_t begin, std::size_t end) {
    multiply_rows(a, first, depth, packed, c, begin, end, product);
  };
  if (c.rows <= rows_per_task || c.rows * c.columns * depth < least_parallel_products) {
    rows(0, c.rows);
  } else {
    // Whole blocks, so that only the last task has a remainder of rows.
    const std::size_t blocks = (c.rows + rows_per_task - 1) / rows_per_task;
    for_each_range(0, blocks, 1, [&](std::size_t first_block, std::size_t last_block) {
      rows(first_block * rows_per_task, std::min(last_block * rows_per_task, c.rows));
    });
  }
}

// `panels(first, depth)` returns packed rows of b.
template <class Real, class Panels>
void multiply_in_depth(const BasicMatrixView<Real>& a, std::size_t depth,
                       const BasicMutableMatrixView<Real>& c, Product product,
                       const Panels& panels) {
  if (depth == 0 && product == Product::overwrite) {
    for (std::size_t r = 0; r < c.rows; ++r) {
      std::fill_n(c.values + r * c.row_stride, c.columns, Real{0});
    }
  }
  for (std::size_t first = 0; first < depth; first += gemm_depth) {
    const std::size_t rows = std::min(gemm_depth, depth - first);
    multiply_packed(a, first, rows, panels(first, rows), c, first == 0 ? product : Product::add);
  }
}

template <class Real>
void product_of(const BasicMatrixView<Real>& a, const BasicMatrixView<Real>& b,
                const BasicMutableMatrixView<Real>& c, Product product) {
  assert(a.rows == c.rows && a.columns == b.rows && b.columns == c.columns);
  if (c.rows == 0 || c.columns == 0) return;
  std::vector<Real> packed(std::min(gemm_depth, b.rows) * packed_columns<Real>(b.columns));
  multiply_in_depth(a, b.rows, c, product, [&](std::size_t first, std::size_t depth) {
    pack_panels(b, first, depth, packed.data());
    return packed.data();
  });
}

template <class Real>
void symmetric_product_of(const BasicMatrixView<Real>& a, const BasicMatrixView<Real>& b,
                          const BasicMutableMatrixView<Real>& c, Product product) {
  assert(c.rows == c.columns);
  const std::size_t n = c.rows;
  for (std::size_t first = 0; first < n; first += symmetric_columns<Real>) {
    const std::size_t width = std::min(symmetric_columns<Real>, n - first);
    product_of(a.block(first, 0, n - first, a.columns), b.block(0, first, b.rows, width),
               c.block(first, first, n - first, width), product);
  }
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < row; ++column)
      c.values[column * c.row_stride + row] = c.values[row * c.row_stride + column];
  }
}

}  // namespace

template <class Real>
BasicPackedMatrix<Real>::BasicPackedMatrix(const BasicMatrixView<Real>& b)
    : rows_(b.rows), columns_(b.columns), panels_(b.rows * packed_columns<Real>(b.columns)) {
  for (std::size_t first = 0; first < rows_; first += gemm_depth) {
    pack_panels(b, first, std::min(gemm_depth, rows_ - first),
                &panels_[first * packed_columns<Real>(columns_)]);
  }
}

template <class Real>
BasicPackedMatrix<Real>::BasicPackedMatrix(std::size_t rows, std::size_t columns,
                                           std::span<const float> values)
    : rows_(rows), columns_(columns), panels_(values.begin(), values.end()) {
  assert(panels_.size() == rows * packed_columns<Real>(columns));
}

template <class Real>
const Real* BasicPackedMatrix<Real>::panels(std::size_t first) const noexcept {
  return panels_.data() + first * packed_columns<Real>(columns_);
}

template class BasicPackedMatrix<double>;
template class BasicPackedMatrix<float>;

namespace {

template <class Real>
void product_of(const BasicMatrixView<Real>& a, const BasicPackedMatrix<Real>& b,
                const BasicMutableMatrixView<Real>& c, Product product) {
  assert(a.rows == c.rows && a.columns == b.rows() && b.columns() == c.columns);
  if (c.rows == 0 || c.columns == 0) return;
  multiply_in_depth(a, b.rows(), c, product,
                    [&](std::size_t first, std::size_t) { return b.panels(first); });
}

}  // namespace

void multiply(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
              Product product) {
  product_of(a, b, c, product);
}
void multiply(const MatrixViewF& a, const MatrixViewF& b, const MutableMatrixViewF& c,
              Product product) {
  product_of(a, b, c, product);
}
void multiply_symmetric(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
                        Product product) {
  symmetric_product_of(a, b, c, product);
}
void multiply_symmetric(const MatrixViewF& a, const MatrixViewF& b, const MutableMatrixViewF& c,
                        Product product) {
  symmetric_product_of(a, b, c, product);
}
void multiply(const MatrixView& a, const PackedMatrix& b, const MutableMatrixView& c,
              Product product) {
  product_of(a, b, c, product);
}
void multiply(const MatrixViewF& a, const PackedMatrixF& b, const MutableMatrixViewF& c,
              Product product) {
  product_of(a, b, c, product);
}

}  // namespace kinemend::nn
