#include "nn/gemm.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "nn/gemm_kernel.hpp"

namespace kinemend::nn {

namespace {

// Below so many products, threads cost more than they bring.
constexpr std::size_t least_parallel_products = std::size_t{1} << 21;
constexpr std::size_t rows_per_task = 64;

void clear(const MutableMatrixView& c) {
  for (std::size_t r = 0; r < c.rows; ++r) {
    std::fill_n(c.values + r * c.row_stride, c.columns, 0.0);
  }
}

}  // namespace

void multiply(const MatrixView& a, const MatrixView& b, const MutableMatrixView& c,
              Product product) {
  assert(a.rows == c.rows && a.columns == b.rows && b.columns == c.columns);
  if (product == Product::overwrite) clear(c);
  if (c.rows == 0 || c.columns == 0) return;
  const std::size_t panel = gemm_panel_columns();
  const std::size_t packed_columns = (b.columns + panel - 1) / panel * panel;
  std::vector<double> packed(std::min(gemm_depth, b.rows) * packed_columns);
  for (std::size_t first = 0; first < b.rows; first += gemm_depth) {
    const std::size_t depth = std::min(gemm_depth, b.rows - first);
    pack_panels(b, first, depth, packed.data());
    const auto rows = [&](std::size_t begin, std::size_t end) {
      multiply_rows(a, first, depth, packed.data(), c, begin, end);
    };
    if (c.rows <= rows_per_task || c.rows * c.columns * depth < least_parallel_products) {
      rows(0, c.rows);
    } else {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, c.rows, rows_per_task),
                        [&](const auto& range) { rows(range.begin(), range.end()); });
    }
  }
}

}  // namespace kinemend::nn
