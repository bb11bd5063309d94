#include <hwy/aligned_allocator.h>

#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/median_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Loads one vector of each row of the window and lets the network work on them, lane by lane.
template <class D>
HWY_INLINE void sort_window(D d, const double* newest_minus_window, std::size_t width,
                            std::size_t channels, const SortingNetwork& network, double* sorted) {
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t k = 0; k < width; ++k) {
    hn::Store(hn::LoadU(d, newest_minus_window + k * channels), d, sorted + k * lanes);
  }
  for (const auto& [low, high] : network) {
    double* a = sorted + low * lanes;
    double* b = sorted + high * lanes;
    const auto x = hn::Load(d, a);
    const auto y = hn::Load(d, b);
    hn::Store(hn::Min(x, y), d, a);
    hn::Store(hn::Max(x, y), d, b);
  }
}

template <class D>
HWY_INLINE std::size_t median_part(D d, const double* centre, std::size_t begin,
                                   std::size_t channels, std::size_t half_window,
                                   const SortingNetwork& network, double* sorted, double* out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t c = begin;
  for (; c + lanes <= channels; c += lanes) {
    sort_window(d, centre + c - half_window * channels, 2 * half_window + 1, channels, network,
                sorted);
    hn::StoreU(hn::Load(d, sorted + half_window * lanes), d, out + c);
  }
  return c;
}

// The median of |x - m| over sorted x: the distances below and above m are two ascending lists a
// and b of h values; with the 0 of m itself, the h-th smallest of both is the smallest max(a_i,
// b_{h-i}), i = 0 to h, where a_0 = b_0 = 0.
template <class D>
HWY_INLINE hn::Vec<D> median_deviation(D d, const double* sorted, std::size_t half_window) {
  const std::size_t lanes = hn::Lanes(d);
  const auto median = hn::Load(d, sorted + half_window * lanes);
  auto result = hn::Sub(hn::Load(d, sorted + 2 * half_window * lanes), median);
  for (std::size_t i = 1; i <= half_window; ++i) {
    const auto below = hn::Sub(median, hn::Load(d, sorted + (half_window - i) * lanes));
    const auto above = hn::Sub(hn::Load(d, sorted + (2 * half_window - i) * lanes), median);
    result = hn::Min(result, hn::Max(below, above));
  }
  return result;
}

template <class D>
HWY_INLINE std::size_t hampel_part(D d, const double* centre, std::size_t begin,
                                   std::size_t channels, std::size_t half_window,
                                   const SortingNetwork& network, const HampelLimits& limits,
                                   double* sorted, double* out, std::uint8_t* marks) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t c = begin;
  for (; c + lanes <= channels; c += lanes) {
    sort_window(d, centre + c - half_window * channels, 2 * half_window + 1, channels, network,
                sorted);
    const auto median = hn::Load(d, sorted + half_window * lanes);
    const auto scale =
        hn::Mul(hn::Set(d, limits.scaled_threshold), median_deviation(d, sorted, half_window));
    const auto limit = hn::Max(scale, hn::Set(d, limits.minimum_deviation));
    const auto x = hn::LoadU(d, centre + c);
    const auto outlier = hn::Gt(hn::Abs(hn::Sub(x, median)), limit);
    hn::StoreU(hn::IfThenElse(outlier, median, x), d, out + c);
    if (hn::AllFalse(d, outlier)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, outlier, bits);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if ((bits[lane / 8] >> (lane % 8)) & 1) marks[c + lane] = 1;
    }
  }
  return c;
}

void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const auto sorted = hwy::AllocateAligned<double>((2 * half_window + 1) * hn::Lanes(wide));
  for (std::size_t t = 0; t < frames; ++t, centre += channels, out += channels) {
    const std::size_t c =
        median_part(wide, centre, 0, channels, half_window, network, sorted.get(), out);
    median_part(narrow, centre, c, channels, half_window, network, sorted.get(), out);
  }
}

void hampel_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, const HampelLimits& limits,
                 double* out, std::uint8_t* marks) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const auto sorted = hwy::AllocateAligned<double>((2 * half_window + 1) * hn::Lanes(wide));
  for (std::size_t t = 0; t < frames; ++t) {
    const std::size_t c = hampel_part(wide, centre, 0, channels, half_window, network, limits,
                                      sorted.get(), out, marks);
    hampel_part(narrow, centre, c, channels, half_window, network, limits, sorted.get(), out,
                marks);
    centre += channels, out += channels, marks += channels;
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {
HWY_EXPORT(median_rows);
HWY_EXPORT(hampel_rows);
void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out) {
  HWY_DYNAMIC_DISPATCH(median_rows)(centre, frames, channels, half_window, network, out);
}
void hampel_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, const HampelLimits& limits,
                 double* out, std::uint8_t* marks) {
  HWY_DYNAMIC_DISPATCH(hampel_rows)
  (centre, frames, channels, half_window, network, limits, out, marks);
}
}  // namespace kinemend::signal
#endif
