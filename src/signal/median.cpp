// Runs the median over channels, with Tukey's rule at the ends. Builds Batcher's network and keeps
// the exchanges on which the median depends.
#include "signal/median.hpp"

#include <algorithm>
#include <memory>

#include "kinemend/extend/signal.hpp"
#include "signal/extension.hpp"
#include "signal/kernels.hpp"

namespace kinemend {

namespace {

// Calls `work` for the frames whose window exceeds the take: all frames of a short one.
template <class Work>
void for_each_end_frame(std::size_t frames, std::size_t half_window, const Work& work) {
  const std::size_t first_end = std::min(half_window, frames);
  const std::size_t last_begin = std::max(first_end, frames - first_end);
  for (std::size_t t = 0; t < first_end; ++t) work(t);
  for (std::size_t t = last_begin; t < frames; ++t) work(t);
}

double median_of(const PoseMatrix& matrix, std::size_t first, std::size_t last, std::size_t channel,
                 std::vector<double>& scratch) {
  scratch.clear();
  for (std::size_t t = first; t <= last; ++t) scratch.push_back(matrix(t, channel));
  return signal::median(scratch);
}

double median_of_three(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Medians of centred windows that shrink towards the ends, in the order of `for_each_end_frame`.
PoseMatrix shrinking_medians(const PoseMatrix& matrix, std::size_t half_window) {
  PoseMatrix medians;
  medians.channels = matrix.channels;
  std::vector<double> scratch;
  for_each_end_frame(matrix.frames, half_window, [&](std::size_t t) {
    const std::size_t reach = std::min({half_window, t, matrix.frames - 1 - t});
    for (std::size_t c = 0; c < matrix.channels; ++c) {
      medians.values.push_back(median_of(matrix, t - reach, t + reach, c, scratch));
    }
    ++medians.frames;
  });
  return medians;
}

// Applies Tukey's rule to both ends, from the original values.
void end_point_rule(PoseMatrix& matrix) {
  const std::size_t last = matrix.frames - 1;
  for (std::size_t c = 0; c < matrix.channels; ++c) {
    const double front = 3 * matrix(1, c) - 2 * matrix(2, c);
    const double back = 3 * matrix(last - 1, c) - 2 * matrix(last - 2, c);
    const double first = median_of_three(matrix(0, c), matrix(1, c), front);
    matrix(last, c) = median_of_three(matrix(last, c), matrix(last - 1, c), back);
    matrix(0, c) = first;
  }
}

// Calls `work(centre, first, count)` for each run of frames with a complete window inside a chunk.
template <class Work>
void for_each_inner_chunk(PoseMatrix& matrix, std::size_t half_window, const Work& work) {
  if (matrix.frames <= 2 * half_window) return;
  signal::for_each_chunk(
      matrix, half_window, [&](const double* centre, std::size_t first, std::size_t count) {
        const std::size_t begin = std::max(first, half_window);
        const std::size_t end = std::min(first + count, matrix.frames - half_window);
        if (begin < end) work(centre + (begin - first) * matrix.channels, begin, end - begin);
      });
}

}  // namespace

void median_filter(PoseMatrix& matrix, std::size_t half_window) {
  if (matrix.frames < 3 || matrix.channels == 0 || half_window == 0) return;
  half_window = std::min(half_window, matrix.frames);
  const PoseMatrix ends = shrinking_medians(matrix, half_window);
  if (matrix.frames > 2 * half_window) {
    const signal::SortingNetwork network = signal::median_network(2 * half_window + 1);
    for_each_inner_chunk(matrix, half_window,
                         [&](const double* centre, std::size_t first, std::size_t count) {
                           signal::median_rows(centre, count, matrix.channels, half_window, network,
                                               &matrix.values[first * matrix.channels]);
                         });
  }
  std::size_t next = 0;
  for_each_end_frame(matrix.frames, half_window, [&](std::size_t t) {
    const auto row = ends.row(next++);
    std::copy(row.begin(), row.end(), matrix.row(t).begin());
  });
  end_point_rule(matrix);
}

}  // namespace kinemend

namespace kinemend::signal {

double median(std::span<const double> values) {
  const std::size_t count = values.size();
  if (count == 0) return 0;
  const std::unique_ptr<double[]> copies(new double[2 * count]);
  std::copy(values.begin(), values.end(), copies.get());
  const Ranked middle = select_rank(copies.get(), count, (count - 1) / 2, copies.get() + count);
  return count % 2 == 1 ? middle.value : (middle.value + middle.next) / 2;
}

SortingNetwork sorting_network(std::size_t width) {
  // The network of the next power of two, without the exchanges that touch the missing (largest)
  // values.
  SortingNetwork network;
  for (std::size_t run = 1; run < width; run *= 2) {
    for (std::size_t gap = run; gap >= 1; gap /= 2) {
      for (std::size_t start = gap % run; start + gap < width; start += 2 * gap) {
        for (std::size_t i = start; i < start + gap && i + gap < width; ++i) {
          if (i / (2 * run) == (i + gap) / (2 * run)) {
            network.emplace_back(static_cast<std::uint32_t>(i),
                                 static_cast<std::uint32_t>(i + gap));
          }
        }
      }
    }
  }
  return network;
}

SortingNetwork median_network(std::size_t width) {
  const SortingNetwork full = sorting_network(width);
  std::vector<bool> needed(width, false);
  needed[width / 2] = true;
  SortingNetwork kept;
  for (auto exchange = full.rbegin(); exchange != full.rend(); ++exchange) {
    if (!needed[exchange->first] && !needed[exchange->second]) continue;
    needed[exchange->first] = needed[exchange->second] = true;
    kept.push_back(*exchange);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

}  // namespace kinemend::signal
