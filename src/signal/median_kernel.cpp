// Running medians by networks of exchanges, and the selection of a rank by vectorised partitioning,
// compiled once for each instruction set.
#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <limits>

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

struct Split {
  std::size_t less;
  std::size_t greater;
};

// Leaves the values below the pivot at the front of `values`, copies those above it to `greater`,
// drops those equal.
HWY_INLINE Split split_at(double* values, std::size_t count, double pivot, double* greater) {
  const hn::ScalableTag<double> d;
  const auto middle = hn::Set(d, pivot);
  Split split = {0, 0};
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const auto value = hn::LoadU(d, values + i);
    // A store may write a whole vector: at the front it never passes what has been read.
    split.less += hn::CompressStore(value, hn::Lt(value, middle), d, values + split.less);
    split.greater += hn::CompressStore(value, hn::Gt(value, middle), d, greater + split.greater);
  }
  for (; i < count; ++i) {
    const double value = values[i];
    if (value < pivot) values[split.less++] = value;
    if (value > pivot) greater[split.greater++] = value;
  }
  return split;
}

// A pivot whose rank is likely near `rank`: the corresponding order statistic of 15 samples.
HWY_INLINE double pivot_near(const double* values, std::size_t count, std::size_t rank) {
  std::array<double, 15> sample;
  for (std::size_t i = 0; i < sample.size(); ++i)
    sample[i] = values[i * (count - 1) / (sample.size() - 1)];
  std::sort(sample.begin(), sample.end());
  return sample[rank * sample.size() / count];
}

Ranked select_rank(double* values, std::size_t count, std::size_t rank, double* scratch) {
  double above =
      std::numeric_limits<double>::infinity();  // the least of the values known to be higher
  while (count > 48) {
    const double pivot = pivot_near(values, count, rank);
    const Split split = split_at(values, count, pivot, scratch);
    const std::size_t up_to_pivot = count - split.greater;
    if (rank < split.less) {
      count = split.less;
      above = pivot;
    } else if (rank < up_to_pivot) {
      if (rank + 1 < up_to_pivot) return {pivot, pivot};
      return {pivot,
              split.greater == 0 ? above : *std::min_element(scratch, scratch + split.greater)};
    } else {
      rank -= up_to_pivot;
      count = split.greater;
      std::swap(values, scratch);
    }
  }
  std::sort(values, values + count);
  return {values[rank], rank + 1 < count ? values[rank + 1] : above};
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {

HWY_EXPORT(median_rows);
HWY_EXPORT(select_rank);

void median_rows(const double* centre, std::size_t frames, std::size_t channels,
                 std::size_t half_window, const SortingNetwork& network, double* out) {
  HWY_DYNAMIC_DISPATCH(median_rows)(centre, frames, channels, half_window, network, out);
}
Ranked select_rank(double* values, std::size_t count, std::size_t rank, double* scratch) {
  return HWY_DYNAMIC_DISPATCH(select_rank)(values, count, rank, scratch);
}

}  // namespace kinemend::signal
#endif
