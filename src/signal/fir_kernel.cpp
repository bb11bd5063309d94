// The inner loop of symmetric FIR filters, compiled once for each instruction set.
#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/fir_kernel.cpp"
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

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {
HWY_EXPORT(symmetric_fir_rows);
void symmetric_fir_rows(const double* centre, std::size_t frames, std::size_t channels,
                        std::span<const double> half_weights, double* out) {
  HWY_DYNAMIC_DISPATCH(symmetric_fir_rows)(centre, frames, channels, half_weights, out);
}
}  // namespace kinemend::signal
#endif
