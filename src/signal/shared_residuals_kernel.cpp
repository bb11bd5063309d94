// The residuals of many smoothing models at once, compiled once for each instruction set.
#include "base/simd.hpp"
#include "signal/whittaker.hpp"
#include "signal/whittaker_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/shared_residuals_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, block_channels>;
using Vector = hn::Vec<Tag>;

// Models processed together, to hide the latency of each one's recursion. For speed, not swept.
constexpr std::size_t models_at_once = 4;

template <std::size_t order>
HWY_INLINE Vector difference_at(const double* y, std::size_t t) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  Vector sum = hn::Zero(d);
  for (std::size_t k = 0; k <= order; ++k)
    sum = hn::Add(sum, hn::Mul(hn::Set(d, c[k]), hn::LoadU(d, y + (t + k) * block_channels)));
  return sum;
}

// Adds differences [first, last) of one vector of columns. `sums` and `before` (order rows) are
// those of the first model; both continue over models and calls.
template <std::size_t order, std::size_t models>
HWY_INLINE void add_residuals(const SharedRows* factors, std::size_t first, std::size_t last,
                              const double* y, double* sums, double* before) {
  const Tag d;
  Vector sum[models], past[models][order];
  for (std::size_t m = 0; m < models; ++m) {
    sum[m] = hn::LoadU(d, sums + m * block_channels);
    for (std::size_t k = 0; k < order; ++k)
      past[m][k] = hn::LoadU(d, before + (m * largest_order + k) * block_channels);
  }
  for (std::size_t t = first; t < last; ++t) {
    const Vector difference = difference_at<order>(y, t);
    for (std::size_t m = 0; m < models; ++m) {
      const std::size_t row = t < factors[m].stored - 1 ? t : factors[m].stored - 1;
      const double* lower = factors[m].lower + row * order;
      Vector value = difference;
      for (std::size_t k = order; k >= 1; --k)
        value = hn::Sub(value, hn::Mul(hn::Set(d, lower[k - 1]), past[m][k - 1]));
      for (std::size_t k = order - 1; k >= 1; --k) past[m][k] = past[m][k - 1];
      past[m][0] = value;
      const Vector scaled = hn::Mul(value, hn::Set(d, factors[m].inverse_diagonal[row]));
      sum[m] = hn::Add(sum[m], hn::Mul(scaled, value));
    }
  }
  for (std::size_t m = 0; m < models; ++m) {
    hn::StoreU(sum[m], d, sums + m * block_channels);
    for (std::size_t k = 0; k < order; ++k)
      hn::StoreU(past[m][k], d, before + (m * largest_order + k) * block_channels);
  }
}

template <std::size_t order>
HWY_INLINE void add_all_residuals(const SharedRows* factors, std::size_t models, std::size_t first,
                                  std::size_t last, const double* y, double* sums, double* before) {
  for (std::size_t c = 0; c < block_channels; c += hn::Lanes(Tag())) {
    std::size_t m = 0;
    const auto of = [c](double* data, std::size_t rows) {
      return data + rows * block_channels + c;
    };
    for (; m + models_at_once <= models; m += models_at_once) {
      add_residuals<order, models_at_once>(factors + m, first, last, y + c, of(sums, m),
                                           of(before, m * largest_order));
    }
    for (; m < models; ++m) {
      add_residuals<order, 1>(factors + m, first, last, y + c, of(sums, m),
                              of(before, m * largest_order));
    }
  }
}

void add_shared_residuals(const SharedRows* factors, std::size_t models, std::size_t first,
                          std::size_t last, const double* y, double* sums, double* before) {
  switch (factors[0].order) {
    case 1:
      return add_all_residuals<1>(factors, models, first, last, y, sums, before);
    case 2:
      return add_all_residuals<2>(factors, models, first, last, y, sums, before);
    default:
      return add_all_residuals<3>(factors, models, first, last, y, sums, before);
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {

HWY_EXPORT(add_shared_residuals);

void add_shared_residuals(const SharedRows* factors, std::size_t models, std::size_t first,
                          std::size_t last, const double* y, double* sums, double* before) {
  HWY_DYNAMIC_DISPATCH(add_shared_residuals)(factors, models, first, last, y, sums, before);
}

}  // namespace kinemend::signal
#endif
