// Extends the rows of each level and splits them into two bands.
#include "signal/wavelet_transform.hpp"

#include <algorithm>

#include "signal/extension.hpp"
#include "signal/kernels.hpp"

namespace kinemend::signal {

namespace {

// g[j] = (-1)^j h[L - 1 - j], the quadrature mirror.
std::vector<double> mirror_filter(std::span<const double> h) {
  std::vector<double> g(h.size());
  for (std::size_t j = 0; j < h.size(); ++j) {
    g[j] = (j % 2 == 0 ? 1 : -1) * h[h.size() - 1 - j];
  }
  return g;
}

// Rows from -(L - 2) to the last one that the filter of a kept coefficient covers.
std::vector<double> extended_rows(const PoseMatrix& matrix, std::size_t before, std::size_t total) {
  std::vector<double> rows(total * matrix.channels);
  std::copy(matrix.values.begin(), matrix.values.end(),
            rows.begin() + static_cast<std::ptrdiff_t>(before * matrix.channels));
  for (std::size_t k = 0; k < total; ++k) {
    if (k == before) k += matrix.frames;
    if (k >= total) break;
    const std::ptrdiff_t frame =
        static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(before);
    point_reflected_row(matrix, frame, &rows[k * matrix.channels]);
  }
  return rows;
}

}  // namespace

WaveletTransform forward_transform(const PoseMatrix& matrix, std::span<const double> scaling_filter,
                                   int levels) {
  const std::size_t taps = scaling_filter.size();
  const std::vector<double> g = mirror_filter(scaling_filter);
  WaveletTransform result;
  result.smooth = matrix;
  for (int level = 0; level < levels; ++level) {
    const std::size_t length = result.smooth.frames;
    const std::size_t count = (length + taps - 1) / 2;
    const std::vector<double> x = extended_rows(result.smooth, taps - 2, 2 * (count - 1) + taps);
    PoseMatrix low(count, matrix.channels);
    PoseMatrix high(count, matrix.channels);
    wavelet_analysis_rows(x.data(), count, matrix.channels, scaling_filter, g, low.values.data(),
                          high.values.data());
    result.lengths.push_back(length);
    result.details.push_back(std::move(high));
    result.smooth = std::move(low);
  }
  return result;
}

void inverse_transform(WaveletTransform transform, std::span<const double> scaling_filter,
                       PoseMatrix& matrix) {
  const std::vector<double> g = mirror_filter(scaling_filter);
  for (std::size_t level = transform.details.size(); level-- > 0;) {
    const std::size_t length = transform.lengths[level];
    PoseMatrix finer;
    PoseMatrix& out = level == 0 ? matrix : finer;
    if (level > 0) finer = PoseMatrix(length, matrix.channels);
    wavelet_synthesis_rows(transform.smooth.values.data(), transform.details[level].values.data(),
                           length, matrix.channels, scaling_filter, g, out.values.data());
    if (level > 0) transform.smooth = std::move(finer);
  }
}

CoefficientRange inner_coefficients(std::size_t length, std::size_t filter_length) {
  // Coefficient k covers rows 2k - (L - 2) to 2k + 1.
  const std::size_t first = (filter_length - 1) / 2;
  const std::size_t last = length / 2;  // one past
  if (first >= last) return {0, (length + filter_length - 1) / 2};
  return {first, last - first};
}

}  // namespace kinemend::signal
