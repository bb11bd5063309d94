// Selection of a rank by vectorised partitioning, compiled once for each instruction set.
#include <algorithm>
#include <array>
#include <limits>

#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/select_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
HWY_EXPORT(select_rank);
Ranked select_rank(double* values, std::size_t count, std::size_t rank, double* scratch) {
  return HWY_DYNAMIC_DISPATCH(select_rank)(values, count, rank, scratch);
}
}  // namespace kinemend::signal
#endif
