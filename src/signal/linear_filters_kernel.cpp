// The inner loops of symmetric FIR filters and of recursive filters, compiled once for each
// instruction set.
#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/linear_filters_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// `vectors` neighbouring vectors at once, so that their sums are independent.
template <std::size_t vectors, class D>
HWY_INLINE std::size_t fir_columns(D d, const double* centre, std::size_t begin, std::size_t end,
                                   std::size_t channels, std::span<const double> w, double* out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t c = begin;
  for (; c + vectors * lanes <= end; c += vectors * lanes) {
    hn::Vec<D> sum[vectors];
    for (std::size_t v = 0; v < vectors; ++v) {
      sum[v] = hn::Mul(hn::Set(d, w[0]), hn::LoadU(d, centre + c + v * lanes));
    }
    const double* before = centre + c;
    const double* behind = centre + c;
    for (std::size_t k = 1; k < w.size(); ++k) {
      before -= channels;
      behind += channels;
      const auto weight = hn::Set(d, w[k]);
      for (std::size_t v = 0; v < vectors; ++v) {
        const auto pair =
            hn::Add(hn::LoadU(d, before + v * lanes), hn::LoadU(d, behind + v * lanes));
        sum[v] = hn::Add(sum[v], hn::Mul(weight, pair));
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) hn::StoreU(sum[v], d, out + c + v * lanes);
  }
  return c;
}

void symmetric_fir_rows(const double* centre, std::size_t frames, std::size_t channels,
                        std::span<const double> half_weights, double* out) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  for (std::size_t t = 0; t < frames; ++t, centre += channels, out += channels) {
    std::size_t c = fir_columns<4>(wide, centre, 0, channels, channels, half_weights, out);
    c = fir_columns<1>(wide, centre, c, channels, channels, half_weights, out);
    fir_columns<1>(narrow, centre, c, channels, channels, half_weights, out);
  }
}

// Transposed direct form II over channels `begin` to `end` of one row, with `sections` of them in
// sequence while the sample is in a register. Memory: two rows per section.
template <std::size_t sections, class D>
HWY_INLINE void filter_columns(D d, double* row, std::size_t begin, std::size_t end,
                               std::size_t channels, const Biquad* biquads, double* memory) {
  for (std::size_t c = begin; c < end; c += hn::Lanes(d)) {
    auto x = hn::LoadU(d, row + c);
    for (std::size_t s = 0; s < sections; ++s) {
      const Biquad& q = biquads[s];
      double* first = memory + 2 * s * channels + c;
      double* second = first + channels;
      const auto y = hn::Add(hn::Mul(hn::Set(d, q.b0), x), hn::LoadU(d, first));
      const auto to_first = hn::Sub(hn::Mul(hn::Set(d, q.b1), x), hn::Mul(hn::Set(d, q.a1), y));
      const auto to_second = hn::Sub(hn::Mul(hn::Set(d, q.b2), x), hn::Mul(hn::Set(d, q.a2), y));
      hn::StoreU(hn::Add(to_first, hn::LoadU(d, second)), d, first);
      hn::StoreU(to_second, d, second);
      x = y;
    }
    hn::StoreU(x, d, row + c);
  }
}

template <std::size_t sections>
HWY_INLINE void filter_row(double* row, std::size_t channels, const Biquad* biquads,
                           double* memory) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const std::size_t whole = channels - channels % hn::Lanes(wide);
  filter_columns<sections>(wide, row, 0, whole, channels, biquads, memory);
  filter_columns<sections>(narrow, row, whole, channels, channels, biquads, memory);
}

void filter_rows(const Rows& rows, std::span<const Biquad> sections, double* memory) {
  for (std::size_t t = 0; t < rows.count; ++t) {
    double* row = rows.first + static_cast<std::ptrdiff_t>(t) * rows.stride;
    std::size_t s = 0;
    for (; s + 2 <= sections.size(); s += 2) {
      filter_row<2>(row, rows.channels, &sections[s], memory + 2 * s * rows.channels);
    }
    if (s < sections.size()) {
      filter_row<1>(row, rows.channels, &sections[s], memory + 2 * s * rows.channels);
    }
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {

HWY_EXPORT(symmetric_fir_rows);
HWY_EXPORT(filter_rows);

void symmetric_fir_rows(const double* centre, std::size_t frames, std::size_t channels,
                        std::span<const double> half_weights, double* out) {
  HWY_DYNAMIC_DISPATCH(symmetric_fir_rows)(centre, frames, channels, half_weights, out);
}
void filter_rows(const Rows& rows, std::span<const Biquad> sections, double* memory) {
  HWY_DYNAMIC_DISPATCH(filter_rows)(rows, sections, memory);
}

}  // namespace kinemend::signal
#endif
