#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinemend/signal.hpp"

/// The hot loops, compiled for each instruction set and chosen at run time. They run along the rows
/// of a frame-major matrix: one vector holds neighbouring channels of a frame. Products and sums
/// stay apart (no fused multiply-add), so that each instruction set gives the same bits.
namespace kinemend::signal {

/// Rows of `channels` doubles, the next row `stride` doubles on (negative: backward in time).
struct Rows {
  double* first;
  std::ptrdiff_t stride;
  std::size_t count;
  std::size_t channels;
};

/// Runs all sections over the rows in place. `memory`: 2 x channels doubles a section, carried on.
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

/// out[t] = median of x[t - half_window .. t + half_window]; the network need only bring the median
/// into place.
void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out);
struct HampelLimits {
  double scaled_threshold;  ///< of the MAD
  double minimum_deviation;
};
/// As `hampel_filter` where the window is whole; sets marks, never clears them.
void hampel_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, const HampelLimits& limits,
                 double* out, std::uint8_t* marks);

/// Kalman filters of `channels` channels, in units where the measurement variance is 1 and the step
/// is one frame. A state has 1 to 3 components (position, velocity, acceleration), stored a row of
/// `channels` values each.
struct KalmanLanes {
  std::size_t components;
  std::size_t channels;
  double* state;        ///< components rows: the prediction for the next frame
  double* covariance;   ///< of the prediction: upper triangle, row by row
  double* gain;         ///< components + 1 rows: what KalmanTrace keeps, of the last frame
  double* first_frame;  ///< 1 row: number of the frame of the first sample; infinite before it
  double* noise;        ///< 1 row: process noise of one frame
  double* prior;        ///< 1 row: variance of each component before the first sample
  bool settled;         ///< whether no covariance changed in the last frame
};
/// What the way back needs of the way forward.
struct KalmanTrace {
  std::vector<double> predicted;  ///< a row a frame: the position predicted
  std::vector<double>
      gains;  ///< components + 1 rows a slot: the position's row of the filtered covariance
              ///< (which is the gain), and 1 / innovation variance, 0 where no sample was
  std::vector<std::size_t> slots;  ///< of each frame; frames with the same gains share one
};
/// A group of channels within the matrix, with their marks (or null); both have the same stride.
struct KalmanRows {
  double* values;
  const std::uint8_t* missing;
  std::size_t stride;
  std::size_t first_frame;
  std::size_t frames;
};
/// Filters in place; or, given a trace, leaves the rows alone and fills it.
void kalman_forward_rows(KalmanLanes& lanes, const KalmanRows& rows, KalmanTrace* trace);
/// The modified Bryson-Frazier form of the Rauch-Tung-Striebel smoother, in place, after the way
/// forward. Overwrites `state`.
void kalman_backward_rows(const KalmanLanes& lanes, const KalmanRows& rows,
                          const KalmanTrace& trace);

struct Ranked {
  double value;
  double next;  ///< of the next higher rank; infinite at the end
};
/// The value that would stand at `rank` were the `count` values sorted. Overwrites `values` and
/// `scratch`, which is as large.
Ranked select_rank(double* values, std::size_t count, std::size_t rank, double* scratch);

}  // namespace kinemend::signal
