// Finds medians of any number of values by selection, and networks of exchanges that find those of
// small windows. Copies the columns of a matrix to contiguous values.
#pragma once

#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "signal/kernels.hpp"

namespace kinemend::signal {

/// The median: the mean of the two middle values for an even count; 0 for no values.
double median(std::span<const double> values);

/// Calls work(channel, values) for each channel with a contiguous copy of rows `first` to `first +
/// count - 1`, which `work` may overwrite. `rows` is frame-major with `channels` columns. Channels
/// are copied eight at a time.
template <class Work>
void for_each_column(const double* rows, std::size_t count, std::size_t channels,
                     const Work& work) {
  // Columns that are copied at once: for speed, not swept.
  constexpr std::size_t block = 8;
  std::vector<double> columns(block * count);
  for (std::size_t first = 0; first < channels; first += block) {
    const std::size_t width = channels - first < block ? channels - first : block;
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t k = 0; k < width; ++k) {
        columns[k * count + t] = rows[t * channels + first + k];
      }
    }
    for (std::size_t k = 0; k < width; ++k) {
      work(first + k, std::span<double>(columns.data() + k * count, count));
    }
  }
}

/// Batcher's odd-even merge sort for any width.
SortingNetwork sorting_network(std::size_t width);
/// The exchanges of that network on which the middle value depends.
SortingNetwork median_network(std::size_t width);

}  // namespace kinemend::signal
