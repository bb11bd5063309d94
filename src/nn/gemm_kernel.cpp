#include "nn/gemm_kernel.hpp"

#include <algorithm>

#include "base/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/gemm_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::nn::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;

constexpr std::size_t panel_vectors = 3;
// A tile of rows x panel_vectors sums, a row of b and one of a have to fit the registers.
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM_A64
constexpr std::size_t tile_rows = 8;
#else
constexpr std::size_t tile_rows = 4;
#endif

constexpr std::size_t pack_rows = 8;

std::size_t panel_columns() { return panel_vectors * hn::Lanes(Tag()); }

void pack(const MatrixView& b, std::size_t first, std::size_t depth, double* packed) {
  const std::size_t width = panel_columns();
  for (std::size_t begin = 0; begin < b.columns; begin += width) {
    const std::size_t count = std::min(width, b.columns - begin);
    const double* from = b.values + first * b.row_stride + begin * b.column_stride;
    for (std::size_t k = 0; k < depth; k += pack_rows) {
      // Of some rows column by column: where columns lie contiguous, cache lines are used whole.
      const std::size_t rows = std::min(pack_rows, depth - k);
      for (std::size_t c = 0; c < count; ++c) {
        const double* column = from + k * b.row_stride + c * b.column_stride;
        for (std::size_t r = 0; r < rows; ++r) packed[r * width + c] = column[r * b.row_stride];
      }
      for (std::size_t r = 0; r < rows; ++r, packed += width)
        std::fill(packed + count, packed + width, 0.0);
    }
  }
}

struct Tile {
  const double* a;
  std::size_t row_stride;
  std::size_t column_stride;
  std::size_t depth;
  const double* panel;
  double* c;
  std::size_t c_stride;
  std::size_t columns;  // of c, at most vectors * lanes
  bool adds;            // to what c holds
};

// The tile's sums stay in registers over the whole depth.
template <std::size_t rows, std::size_t vectors>
HWY_INLINE void multiply_tile(const Tile& tile) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t width = panel_vectors * lanes;
  hn::Vec<Tag> sum[rows][vectors];
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t v = 0; v < vectors; ++v) sum[r][v] = hn::Zero(d);
  }
  const double* a = tile.a;
  const double* panel = tile.panel;
  for (std::size_t k = 0; k < tile.depth; ++k, a += tile.column_stride, panel += width) {
    hn::Vec<Tag> b[vectors];
    for (std::size_t v = 0; v < vectors; ++v) b[v] = hn::LoadU(d, panel + v * lanes);
    for (std::size_t r = 0; r < rows; ++r) {
      const auto factor = hn::Set(d, a[r * tile.row_stride]);
      for (std::size_t v = 0; v < vectors; ++v) {
        sum[r][v] = hn::Add(sum[r][v], hn::Mul(factor, b[v]));
      }
    }
  }
  for (std::size_t r = 0; r < rows; ++r) {
    double* c = tile.c + r * tile.c_stride;
    for (std::size_t v = 0; v < vectors; ++v) {
      const std::size_t from = v * lanes;
      if (from + lanes <= tile.columns) {
        const auto old = tile.adds ? hn::LoadU(d, c + from) : hn::Zero(d);
        hn::StoreU(hn::Add(old, sum[r][v]), d, c + from);
      } else if (from < tile.columns) {
        const auto mask = hn::FirstN(d, tile.columns - from);
        const auto old = tile.adds ? hn::MaskedLoad(mask, d, c + from) : hn::Zero(d);
        hn::BlendedStore(hn::Add(old, sum[r][v]), mask, d, c + from);
      }
    }
  }
}

template <std::size_t rows>
HWY_INLINE void multiply_tile_of(const Tile& tile) {
  const std::size_t lanes = hn::Lanes(Tag());
  if (tile.columns > 2 * lanes) {
    multiply_tile<rows, 3>(tile);
  } else if (tile.columns > lanes) {
    multiply_tile<rows, 2>(tile);
  } else {
    multiply_tile<rows, 1>(tile);
  }
}

void rows_of_product(const MatrixView& a, std::size_t first, std::size_t depth,
                     const double* packed, const MutableMatrixView& c, std::size_t first_row,
                     std::size_t last_row, Product product) {
  const std::size_t width = panel_columns();
  for (std::size_t column = 0; column < c.columns; column += width, packed += depth * width) {
    Tile tile{nullptr,
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

}  // namespace kinemend::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::nn {
HWY_EXPORT(panel_columns);
HWY_EXPORT(pack);
HWY_EXPORT(rows_of_product);
std::size_t gemm_panel_columns() { return HWY_DYNAMIC_DISPATCH(panel_columns)(); }
void pack_panels(const MatrixView& b, std::size_t first, std::size_t depth, double* packed) {
  HWY_DYNAMIC_DISPATCH(pack)(b, first, depth, packed);
}
void multiply_rows(const MatrixView& a, std::size_t first, std::size_t depth, const double* packed,
                   const MutableMatrixView& c, std::size_t first_row, std::size_t last_row,
                   Product product) {
  HWY_DYNAMIC_DISPATCH(rows_of_product)(a, first, depth, packed, c, first_row, last_row, product);
}
}  // namespace kinemend::nn
#endif
