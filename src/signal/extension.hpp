// Checks the arguments of filters, and extends matrices beyond their ends by point reflection, for
// filters that work in place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend::signal {

/// Writes the row at `frame` of the matrix extended by repeated point reflection at its ends: x[-k]
/// = 2 x[0] - x[k], x[n+k] = 2 x[n] - x[n-k] with n = F - 1. `frame` may have any value; F >= 1.
void point_reflected_row(const PoseMatrix& matrix, std::ptrdiff_t frame, double* out);

/// Visits windows of a matrix that is being overwritten: calls work(centre, first, count), where
/// `centre` is row `first` in a copy of the input with `radius` point-reflected or original rows
/// before and after the `count` rows. `work` may write rows first to first + count - 1 of the
/// matrix.
template <class Work>
void for_each_chunk(PoseMatrix& matrix, std::size_t radius, const Work& work) {
  const std::size_t frames = matrix.frames;
  const std::size_t channels = matrix.channels;
  if (frames == 0 || channels == 0) return;
  const std::size_t chunk = radius > 24 ? 2 * radius : 48;
  const std::size_t row_bytes = channels * sizeof(double);

  std::vector<double> tail(radius * channels);
  for (std::size_t k = 0; k < radius; ++k) {
    point_reflected_row(matrix, static_cast<std::ptrdiff_t>(frames + k), &tail[k * channels]);
  }
  std::vector<double> window((chunk + 2 * radius) * channels);
  for (std::size_t k = 0; k < radius; ++k) {
    point_reflected_row(matrix,
                        static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(radius),
                        &window[k * channels]);
  }
  std::size_t loaded = 0;  // rows of the input, reflected tail included, read so far
  std::size_t held = radius;
  for (std::size_t first = 0; first < frames; first += chunk) {
    const std::size_t count = first + chunk < frames ? chunk : frames - first;
    for (; held < count + 2 * radius; ++held, ++loaded) {
      const double* row =
          loaded < frames ? &matrix.values[loaded * channels] : &tail[(loaded - frames) * channels];
      std::memcpy(&window[held * channels], row, row_bytes);
    }
    work(window.data() + radius * channels, first, count);
    std::memmove(window.data(), window.data() + count * channels, 2 * radius * row_bytes);
    held = 2 * radius;
  }
}

inline void require(bool condition, const std::string& message) {
  if (!condition) throw Error(ErrorKind::usage, message);
}

inline void require_marks(const PoseMatrix& matrix, std::span<const std::uint8_t> marks) {
  require(marks.empty() || marks.size() == matrix.frames * matrix.channels,
          "the marks of missing samples are not as many as the samples");
}

}  // namespace kinemend::signal
