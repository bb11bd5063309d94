// Denoises channels by shrinking their wavelet coefficients, transforms channels and back, and
// looks up the filters of Daubechies wavelets and symlets.
#include "signal/wavelet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/signal.hpp"
#include "signal/extension.hpp"
#include "signal/kernels.hpp"
#include "signal/median.hpp"
#include "signal/wavelet_table.hpp"

namespace kinemend {

namespace {

using signal::CoefficientRange;

// The most levels at which the coarsest has about as many coefficients as the filter has taps; at
// least one level.
int automatic_levels(std::size_t frames, std::size_t filter_length) {
  int levels = 0;
  std::size_t length = frames;
  while (length / 2 >= std::max<std::size_t>(filter_length - 1, 2)) {
    length /= 2;
    ++levels;
  }
  return std::max(levels, 1);
}

double universal_threshold(std::size_t count) {
  return std::sqrt(2 * portable::log(static_cast<double>(std::max<std::size_t>(count, 2))));
}

// SureShrink's threshold for coefficients in units of the noise (Donoho & Johnstone 1995, eq. 11
// and section 2.4). Stein's estimate of the risk at the k-th smallest square s_k is n - 2 (k + 1) +
// sum_{i<=k} s_i + (n - 1 - k) s_k. If the mean square barely exceeds that of the noise, the
// variance of the estimate is too large, and the universal threshold is used.
double sure_threshold(std::span<double> coefficients) {
  const std::size_t count = coefficients.size();
  const auto n = static_cast<double>(count);
  double energy = 0;
  for (double& x : coefficients) {
    x *= x;
    energy += x;
  }
  const double universal = universal_threshold(count);
  const double sparse = portable::pow(portable::log2(n), 1.5) / std::sqrt(n);
  if (count < 2 || energy / n - 1 <= sparse) return universal;

  std::sort(coefficients.begin(), coefficients.end());
  double least_risk = n;  // of threshold 0
  double best = 0;
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double square = coefficients[k];
    if (square > universal * universal) break;
    sum += square;
    const auto kept = static_cast<double>(count - 1 - k);
    const double risk = n - 2 * static_cast<double>(k + 1) + sum + kept * square;
    if (risk < least_risk) {
      least_risk = risk;
      best = square;
    }
  }
  return std::sqrt(best);
}

void shrink(PoseMatrix& details, const std::vector<double>& thresholds,
            WaveletShrinkage shrinkage) {
  const bool soft = shrinkage == WaveletShrinkage::soft;
  for (std::size_t k = 0; k < details.frames; ++k) {
    double* row = details.row(k).data();
    for (std::size_t c = 0; c < details.channels; ++c) {
      const double size = std::abs(row[c]);
      const double left = soft ? size - thresholds[c] : size;
      row[c] = size > thresholds[c] ? std::copysign(left, row[c]) : 0.0;
    }
  }
}

std::vector<double> noise_of(const PoseMatrix& finest, CoefficientRange range, double scale) {
  std::vector<double> noise(finest.channels);
  signal::for_each_column(finest.row(range.first).data(), range.count, finest.channels,
                          [&](std::size_t channel, std::span<double> values) {
                            for (double& x : values) x = std::abs(x);
                            noise[channel] = scale * deviations_per_median * signal::median(values);
                          });
  return noise;
}

std::vector<double> thresholds_of(const PoseMatrix& details, CoefficientRange range,
                                  const std::vector<double>& noise, std::size_t frames,
                                  WaveletThreshold kind) {
  std::vector<double> thresholds(details.channels, 0.0);
  if (kind == WaveletThreshold::universal) {
    const double factor = universal_threshold(frames);
    for (std::size_t c = 0; c < noise.size(); ++c) thresholds[c] = factor * noise[c];
    return thresholds;
  }
  signal::for_each_column(details.row(range.first).data(), range.count, details.channels,
                          [&](std::size_t channel, std::span<double> values) {
                            if (noise[channel] <= 0) return;
                            for (double& x : values) x /= noise[channel];
                            thresholds[channel] = noise[channel] * sure_threshold(values);
                          });
  return thresholds;
}

void denoise_group(PoseMatrix& group, std::span<const double> h, int levels,
                   const WaveletOptions& options) {
  signal::WaveletTransform transform = signal::forward_transform(group, h, levels);
  std::vector<double> noise;
  for (std::size_t level = 0; level < transform.details.size(); ++level) {
    PoseMatrix& details = transform.details[level];
    const CoefficientRange range = signal::inner_coefficients(transform.lengths[level], h.size());
    if (level == 0) noise = noise_of(details, range, options.noise_scale);
    shrink(details, thresholds_of(details, range, noise, group.frames, options.threshold),
           options.shrinkage);
  }
  signal::inverse_transform(std::move(transform), h, group);
}

}  // namespace

void wavelet_denoise(PoseMatrix& matrix, const WaveletOptions& options) {
  const std::vector<double> h = wavelet_filter(options.family, options.vanishing_moments);
  signal::require(options.levels >= 0 && options.levels <= 20,
                  fmt::format("{} wavelet levels are outside 0 to 20", options.levels));
  signal::require(options.noise_scale >= 0 && std::isfinite(options.noise_scale),
                  fmt::format("a noise scale of {} makes no sense", options.noise_scale));
  if (matrix.frames < 4 || matrix.channels == 0 || options.noise_scale == 0) return;

  const int levels =
      options.levels > 0 ? options.levels : automatic_levels(matrix.frames, h.size());
  // A few channels at a time, so that all levels of a take of some minutes fit the cache. For
  // speed, not swept.
  constexpr std::size_t group_width = 16;
  PoseMatrix group;
  for (std::size_t first = 0; first < matrix.channels; first += group_width) {
    const std::size_t width = std::min(group_width, matrix.channels - first);
    const auto offset = static_cast<std::ptrdiff_t>(first);
    if (group.channels != width) group = PoseMatrix(matrix.frames, width);
    for (std::size_t t = 0; t < matrix.frames; ++t) {
      std::copy_n(matrix.row(t).begin() + offset, width, group.row(t).begin());
    }
    denoise_group(group, h, levels, options);
    for (std::size_t t = 0; t < matrix.frames; ++t) {
      std::copy_n(group.row(t).begin(), width, matrix.row(t).begin() + offset);
    }
  }
}

std::vector<double> wavelet_filter(WaveletFamily family, int vanishing_moments) {
  const bool symlet = family == WaveletFamily::symlet;
  const int fewest = symlet ? 2 : 1;
  signal::require(vanishing_moments >= fewest && vanishing_moments <= signal::most_moments,
                  fmt::format("{} vanishing moments are outside {} to {}", vanishing_moments,
                              fewest, signal::most_moments));
  const double* filter = symlet ? signal::symlet_filters : signal::daubechies_filters;
  for (int moments = fewest; moments < vanishing_moments; ++moments) filter += 2 * moments;
  return {filter, filter + 2 * vanishing_moments};
}

}  // namespace kinemend

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
