// The hot loops, compiled for each instruction set and chosen at run time. They run along the rows
// of a frame-major matrix: one vector holds neighbouring channels of a frame. Products and sums are
// not fused, so that each instruction set gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinemend/extend/signal.hpp"

namespace kinemend::signal {

/// Rows of `channels` doubles, the next row `stride` doubles on (negative: backward in time).
struct Rows {
  double* first;
  std::ptrdiff_t stride;
  std::size_t count;
  std::size_t channels;
};

/// Runs all sections over the rows in place. `memory`: 2 x channels doubles per section, updated.
void filter_rows(const Rows& rows, std::span<const Biquad> sections, double* memory);

/// out[t] = w[0] x[t] + sum_k w[k] (x[t-k] + x[t+k]); rows are contiguous, `centre` is x[0].
void symmetric_fir_rows(const double* centre, std::size_t frames, std::size_t channels,
                        std::span<const double> half_weights, double* out);

/// low[k] = sum_j h[j] x[2k + j], high[k] the same with g; `count` rows each, all contiguous.
void wavelet_analysis_rows(const double* x, std::size_t count, std::size_t channels,
                           std::span<const double> h, std::span<const double> g, double* low,
                           double* high);
/// The transpose: out[i] = sum_k h[i - 2k + L - 2] low[k] + g[...] high[k] for `frames` rows.
void wavelet_synthesis_rows(const double* low, const double* high, std::size_t frames,
                            std::size_t channels, std::span<const double> h,
                            std::span<const double> g, double* out);

/// Compare-and-exchange pairs that sort `width` values ascending.
using SortingNetwork = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// out[t] = median of x[t - half_window .. t + half_window]; the network only needs to sort the
/// median.
void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out);

struct Ranked {
  double value;
  double next;  ///< of the next higher rank; infinite at the end
};
/// The value at `rank` if the `count` values were sorted. Overwrites `values` and `scratch`, which
/// has the same size.
Ranked select_rank(double* values, std::size_t count, std::size_t rank, double* scratch);

}  // namespace kinemend::signal
