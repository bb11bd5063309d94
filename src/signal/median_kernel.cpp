// The inner loop of running medians, compiled once for each instruction set.
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

// Applies the network to one vector of each row of the window, lane by lane.
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
HWY_INLINE std::size_t median_columns(D d, const double* centre, std::size_t begin,
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

void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const auto sorted = hwy::AllocateAligned<double>((2 * half_window + 1) * hn::Lanes(wide));
  for (std::size_t t = 0; t < frames; ++t, centre += channels, out += channels) {
    const std::size_t c =
        median_columns(wide, centre, 0, channels, half_window, network, sorted.get(), out);
    median_columns(narrow, centre, c, channels, half_window, network, sorted.get(), out);
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {
HWY_EXPORT(median_rows);
void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out) {
  HWY_DYNAMIC_DISPATCH(median_rows)(centre, frames, channels, half_window, network, out);
}
}  // namespace kinemend::signal
#endif
