// The inner loop of the bank of smoothers, compiled once for each instruction set.
#include "base/simd.hpp"
#include "methods/learned/motion_steps.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/learned/smoother_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;

// The sums of a block of columns stay in registers over all rows.
template <std::size_t vectors>
HWY_INLINE void sum_columns(const float* middle, std::size_t width, std::span<const float> taps,
                            float* result) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<Tag> sums[vectors];
  const auto first = hn::Set(d, taps[0]);
  for (std::size_t v = 0; v < vectors; ++v)
    sums[v] = hn::Mul(first, hn::LoadU(d, middle + v * lanes));
  const float *left = middle, *right = middle;
  for (std::size_t k = 1; k < taps.size(); ++k) {
    left -= width;
    right += width;
    const auto tap = hn::Set(d, taps[k]);
    for (std::size_t v = 0; v < vectors; ++v) {
      const auto both = hn::Add(hn::LoadU(d, left + v * lanes), hn::LoadU(d, right + v * lanes));
      sums[v] = hn::Add(sums[v], hn::Mul(tap, both));
    }
  }
  for (std::size_t v = 0; v < vectors; ++v) hn::StoreU(sums[v], d, result + v * lanes);
}

void sum_rows_f32(const float* middle, std::size_t width, std::span<const float> taps,
                  float* result) {
  // For speed, not swept.
  constexpr std::size_t block = 4;  // vectors of columns at once, whose sums fit the registers
  const std::size_t lanes = hn::Lanes(Tag());
  std::size_t c = 0;
  for (; c + block * lanes <= width; c += block * lanes)
    sum_columns<block>(middle + c, width, taps, result + c);
  for (; c + lanes <= width; c += lanes) sum_columns<1>(middle + c, width, taps, result + c);
  for (; c < width; ++c) {
    float sum = taps[0] * middle[c];
    const float *left = middle + c, *right = middle + c;
    for (std::size_t k = 1; k < taps.size(); ++k) {
      left -= width;
      right += width;
      sum += taps[k] * (*left + *right);
    }
    result[c] = sum;
  }
}

}  // namespace kinemend::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend {
HWY_EXPORT(sum_rows_f32);

void sum_rows(const float* middle, std::size_t width, std::span<const float> taps, float* result) {
  HWY_DYNAMIC_DISPATCH(sum_rows_f32)(middle, width, taps, result);
}
}  // namespace kinemend
#endif
