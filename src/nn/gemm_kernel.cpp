// Multiplies tiles whose sums stay in registers, compiled once for each instruction set.
#include "nn/kernels.hpp"

#include <algorithm>

#include "base/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/gemm_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/some_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinemend::nn::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using Tag = hn::ScalableTag<Real>;

// For speed, not swept.
constexpr std::size_t panel_vectors = 3;
// A tile of rows x panel_vectors sums, a row of b and one of a must fit the registers.
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM_A64
constexpr std::size_t tile_rows = 8;
#else
constexpr std::size_t tile_rows = 4;
#endif

// For speed, not swept.
constexpr std::size_t pack_rows = 8;

template <class Real>
std::size_t panel_columns() {
  return panel_vectors * hn::Lanes(Tag<Real>());
}

template <class Real>
void pack(const BasicMatrixView<Real>& b, std::size_t first, std::size_t depth, Real* packed) {
  const std::size_t width = panel_columns<Real>();
  for (std::size_t begin = 0; begin < b.columns; begin += width) {
    const std::size_t count = std::min(width, b.columns - begin);
    const Real* from = b.values + first * b.row_stride + begin * b.column_stride;
    for (std::size_t k = 0; k < depth; k += pack_rows) {
      // Copies some rows column by column: if columns are contiguous, cache lines are used whole.
      const std::size_t rows = std::min(pack_rows, depth - k);
      for (std::size_t c = 0; c < count; ++c) {
        const Real* column = from + k * b.row_stride + c * b.column_stride;
        for (std::size_t r = 0; r < rows; ++r) packed[r * width + c] = column[r * b.row_stride];
      }
      for (std::size_t r = 0; r < rows; ++r, packed += width)
        std::fill(packed + count, packed + width, Real{0});
    }
  }
}

template <class Real>
struct Tile {
  const Real* a;
  std::size_t row_stride;
  std::size_t column_stride;
  std::size_t depth;
  const Real* panel;
  Real* c;
  std::size_t c_stride;
  std::size_t columns;  // of c, at most vectors * lanes
  bool adds;            // to the values in c
};

// The tile's sums stay in registers over the whole depth.
template <std::size_t rows, std::size_t vectors, class Real>
HWY_INLINE void multiply_tile(const Tile<Real>& tile) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t width = panel_vectors * lanes;
  hn::Vec<Tag<Real>> sum[rows][vectors];
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t v = 0; v < vectors; ++v) sum[r][v] = hn::Zero(d);
  }
  const Real* a = tile.a;
  const Real* panel = tile.panel;
  for (std::size_t k = 0; k < tile.depth; ++k, a += tile.column_stride, panel += width) {
    hn::Vec<Tag<Real>> b[vectors];
    for (std::size_t v = 0; v < vectors; ++v) b[v] = hn::LoadU(d, panel + v * lanes);
    for (std::size_t r = 0; r < rows; ++r) {
      const auto factor = hn::Set(d, a[r * tile.row_stride]);
      for (std::size_t v = 0; v < vectors; ++v) {
        sum[r][v] = hn::Add(sum[r][v], hn::Mul(factor, b[v]));
      }
    }
  }
  for (std::size_t r = 0; r < rows; ++r) {
    Real* c = tile.c + r * tile.c_stride;
    for (std::size_t v = 0; v < vectors; ++v) {
      const std::size_t from = v * lanes;
      if (from + lanes <= tile.columns) {
        const auto old = tile.adds ? hn::LoadU(d, c + from) : hn::Zero(d);
        hn::StoreU(hn::Add(old, sum[r][v]), d, c + from);
      } else if (from < tile.columns) {
        const std::size_t count = tile.columns - from;
        const auto old = tile.adds ? load_some(d, c + from, count) : hn::Zero(d);
        store_some(hn::Add(old, sum[r][v]), d, c + from, count);
      }
    }
  }
}

template <std::size_t rows, class Real>
HWY_INLINE void multiply_tile_of(const Tile<Real>& tile) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  if (tile.columns > 2 * lanes) {
    multiply_tile<rows, 3>(tile);
  } else if (tile.columns > lanes) {
    multiply_tile<rows, 2>(tile);
  } else {
    multiply_tile<rows, 1>(tile);
  }
}

template <class Real>
void rows_of_product(const BasicMatrixView<Real>& a, std::size_t first, std::size_t depth,
                     const Real* packed, const BasicMutableMatrixView<Real>& c,
                     std::size_t first_row, std::size_t last_row, Product product) {
  const std::size_t width = panel_columns<Real>();
  for (std::size_t column = 0; column < c.columns; column += width, packed += depth * width) {
    Tile<Real> tile{nullptr,
                    a.row_stride,
                    a.column_stride,
                    depth,
                    packed,
                    nullptr,
                    c.row_stride,
                    std::min(width, c.columns - column),
                    product == Product::add};
    std::size_t row = first_row;
    const auto place = [&] {
      tile.a = a.values + row * a.row_stride + first * a.column_stride;
      tile.c = c.values + row * c.row_stride + column;
    };
    for (; row + tile_rows <= last_row; row += tile_rows) {
      place();
      multiply_tile_of<tile_rows>(tile);
    }
    for (; row + 4 <= last_row; row += 4) {
      place();
      multiply_tile_of<4>(tile);
    }
    for (; row + 2 <= last_row; row += 2) {
      place();
      multiply_tile_of<2>(tile);
    }
    if (row < last_row) {
      place();
      multiply_tile_of<1>(tile);
    }
  }
}

// Dispatch requires functions, not templates.
std::size_t panel_columns_f64() { return panel_columns<double>(); }
std::size_t panel_columns_f32() { return panel_columns<float>(); }
void pack_f64(const MatrixView& b, std::size_t first, std::size_t depth, double* packed) {
  pack(b, first, depth, packed);
}
void pack_f32(const MatrixViewF& b, std::size_t first, std::size_t depth, float* packed) {
  pack(b, first, depth, packed);
}
void rows_f64(const MatrixView& a, std::size_t first, std::size_t depth, const double* packed,
              const MutableMatrixView& c, std::size_t first_row, std::size_t last_row,
              Product product) {
  rows_of_product(a, first, depth, packed, c, first_row, last_row, product);
}
void rows_f32(const MatrixViewF& a, std::size_t first, std::size_t depth, const float* packed,
              const MutableMatrixViewF& c, std::size_t first_row, std::size_t last_row,
              Product product) {
  rows_of_product(a, first, depth, packed, c, first_row, last_row, product);
}

}  // namespace kinemend::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::nn {
HWY_EXPORT(panel_columns_f64);
HWY_EXPORT(panel_columns_f32);
HWY_EXPORT(pack_f64);
HWY_EXPORT(pack_f32);
HWY_EXPORT(rows_f64);
HWY_EXPORT(rows_f32);

template <>
std::size_t gemm_panel_columns<double>() {
  return HWY_DYNAMIC_DISPATCH(panel_columns_f64)();
}
template <>
std::size_t gemm_panel_columns<float>() {
  return HWY_DYNAMIC_DISPATCH(panel_columns_f32)();
}
void pack_panels(const MatrixView& b, std::size_t first, std::size_t depth, double* packed) {
  HWY_DYNAMIC_DISPATCH(pack_f64)(b, first, depth, packed);
}
void pack_panels(const MatrixViewF& b, std::size_t first, std::size_t depth, float* packed) {
  HWY_DYNAMIC_DISPATCH(pack_f32)(b, first, depth, packed);
}
void multiply_rows(const MatrixView& a, std::size_t first, std::size_t depth, const double* packed,
                   const MutableMatrixView& c, std::size_t first_row, std::size_t last_row,
                   Product product) {
  HWY_DYNAMIC_DISPATCH(rows_f64)(a, first, depth, packed, c, first_row, last_row, product);
}
void multiply_rows(const MatrixViewF& a, std::size_t first, std::size_t depth, const float* packed,
                   const MutableMatrixViewF& c, std::size_t first_row, std::size_t last_row,
                   Product product) {
  HWY_DYNAMIC_DISPATCH(rows_f32)(a, first, depth, packed, c, first_row, last_row, product);
}
}  // namespace kinemend::nn
#endif
