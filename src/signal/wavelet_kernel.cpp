// The inner loops of the wavelet transform, compiled once for each instruction set.
#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/wavelet_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <std::size_t vectors, class D>
HWY_INLINE std::size_t analysis_columns(D d, const double* x, std::size_t begin,
                                        std::size_t channels, std::span<const double> h,
                                        std::span<const double> g, double* low, double* high) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t c = begin;
  for (; c + vectors * lanes <= channels; c += vectors * lanes) {
    hn::Vec<D> low_sum[vectors];
    hn::Vec<D> high_sum[vectors];
    for (std::size_t v = 0; v < vectors; ++v) low_sum[v] = high_sum[v] = hn::Zero(d);
    const double* row = x + c;
    for (std::size_t j = 0; j < h.size(); ++j, row += channels) {
      for (std::size_t v = 0; v < vectors; ++v) {
        const auto value = hn::LoadU(d, row + v * lanes);
        low_sum[v] = hn::Add(low_sum[v], hn::Mul(hn::Set(d, h[j]), value));
        high_sum[v] = hn::Add(high_sum[v], hn::Mul(hn::Set(d, g[j]), value));
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) {
      hn::StoreU(low_sum[v], d, low + c + v * lanes);
      hn::StoreU(high_sum[v], d, high + c + v * lanes);
    }
  }
  return c;
}

void wavelet_analysis_rows(const double* x, std::size_t count, std::size_t channels,
                           std::span<const double> h, std::span<const double> g, double* low,
                           double* high) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t c = analysis_columns<4>(wide, x, 0, channels, h, g, low, high);
    c = analysis_columns<1>(wide, x, c, channels, h, g, low, high);
    analysis_columns<1>(narrow, x, c, channels, h, g, low, high);
    x += 2 * channels, low += channels, high += channels;
  }
}

// Uses every second tap, from `tap` down, on neighbouring rows of both bands.
template <std::size_t vectors, class D>
HWY_INLINE std::size_t synthesis_columns(D d, const double* low, const double* high,
                                         std::size_t tap, std::size_t begin, std::size_t channels,
                                         std::span<const double> h, std::span<const double> g,
                                         double* out) {
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t taps = h.size() / 2;
  std::size_t c = begin;
  for (; c + vectors * lanes <= channels; c += vectors * lanes) {
    hn::Vec<D> sum[vectors];
    for (std::size_t v = 0; v < vectors; ++v) sum[v] = hn::Zero(d);
    const double* low_row = low + c;
    const double* high_row = high + c;
    for (std::size_t i = 0; i < taps; ++i, low_row += channels, high_row += channels) {
      const auto low_weight = hn::Set(d, h[tap - 2 * i]);
      const auto high_weight = hn::Set(d, g[tap - 2 * i]);
      for (std::size_t v = 0; v < vectors; ++v) {
        const auto pair = hn::Add(hn::Mul(low_weight, hn::LoadU(d, low_row + v * lanes)),
                                  hn::Mul(high_weight, hn::LoadU(d, high_row + v * lanes)));
        sum[v] = hn::Add(sum[v], pair);
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) hn::StoreU(sum[v], d, out + c + v * lanes);
  }
  return c;
}

void wavelet_synthesis_rows(const double* low, const double* high, std::size_t frames,
                            std::size_t channels, std::span<const double> h,
                            std::span<const double> g, double* out) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  for (std::size_t t = 0; t < frames; ++t, out += channels) {
    // Row t starts at coefficient t / 2: with tap L - 2 if t is even, L - 1 if it is odd.
    const std::size_t tap = h.size() - 2 + t % 2;
    const std::size_t offset = t / 2 * channels;
    std::size_t c =
        synthesis_columns<4>(wide, low + offset, high + offset, tap, 0, channels, h, g, out);
    c = synthesis_columns<1>(wide, low + offset, high + offset, tap, c, channels, h, g, out);
    synthesis_columns<1>(narrow, low + offset, high + offset, tap, c, channels, h, g, out);
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {
HWY_EXPORT(wavelet_analysis_rows);
HWY_EXPORT(wavelet_synthesis_rows);
void wavelet_analysis_rows(const double* x, std::size_t count, std::size_t channels,
                           std::span<const double> h, std::span<const double> g, double* low,
                           double* high) {
  HWY_DYNAMIC_DISPATCH(wavelet_analysis_rows)(x, count, channels, h, g, low, high);
}
void wavelet_synthesis_rows(const double* low, const double* high, std::size_t frames,
                            std::size_t channels, std::span<const double> h,
                            std::span<const double> g, double* out) {
  HWY_DYNAMIC_DISPATCH(wavelet_synthesis_rows)(low, high, frames, channels, h, g, out);
}
}  // namespace kinemend::signal
#endif
