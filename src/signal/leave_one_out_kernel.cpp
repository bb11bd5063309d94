// The recursions of leave-one-out predictions, compiled once for each instruction set.
#include "signal/whittaker_kernels.hpp"

#include "base/simd.hpp"
#include "signal/leave_one_out.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/leave_one_out_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, block_channels>;
using Vector = hn::Vec<Tag>;

// The order of `LeaveOneOut`, by definition.
constexpr std::size_t order = 2;
constexpr double coefficients[] = {1, -2, 1};

// Vectors of a row.
constexpr std::size_t columns() { return lane_row / hn::MaxLanes(Tag()); }

HWY_INLINE Vector at(const double* data, std::size_t row, std::size_t column) {
  return hn::LoadU(Tag(), data + row * lane_row + column * hn::Lanes(Tag()));
}
HWY_INLINE void put(Vector value, double* data, std::size_t row, std::size_t column) {
  hn::StoreU(value, Tag(), data + row * lane_row + column * hn::Lanes(Tag()));
}

// The row of the factor for a difference.
HWY_INLINE std::size_t stored(const SharedRows& factor, std::size_t t) {
  return t < factor.stored - 1 ? t : factor.stored - 1;
}
HWY_INLINE Vector lower_of(const SharedRows& factor, std::size_t t, std::size_t k) {
  return hn::Set(Tag(), factor.lower[stored(factor, t) * order + k - 1]);
}

void lanes_forward(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
                   double* v, std::size_t v_first) {
  const Tag d;
  for (std::size_t t = first; t < last; ++t) {
    const Vector l1 = lower_of(factor, t, 1), l2 = lower_of(factor, t, 2);
    for (std::size_t c = 0; c < columns(); ++c) {
      Vector value = hn::Zero(d);
      for (std::size_t k = 0; k <= order; ++k)
        value = hn::Add(value, hn::Mul(hn::Set(d, coefficients[k]), at(y, t + k, c)));
      if (t >= 2) value = hn::Sub(value, hn::Mul(l2, at(v, t - 2 - v_first, c)));
      if (t >= 1) value = hn::Sub(value, hn::Mul(l1, at(v, t - 1 - v_first, c)));
      put(value, v, t - v_first, c);
    }
  }
}

void lanes_backward(const SharedRows& factor, std::size_t first, std::size_t kept, std::size_t last,
                    const double* v, std::size_t v_first, double* u) {
  const Tag d;
  Vector next[columns()], after_next[columns()];
  for (std::size_t c = 0; c < columns(); ++c) next[c] = after_next[c] = hn::Zero(d);
  for (std::size_t t = last; t-- > first;) {
    const Vector inverse = hn::Set(d, factor.inverse_diagonal[stored(factor, t)]);
    const Vector l1 = lower_of(factor, t + 1, 1), l2 = lower_of(factor, t + 2, 2);
    for (std::size_t c = 0; c < columns(); ++c) {
      Vector value = hn::Mul(at(v, t - v_first, c), inverse);
      if (t + 2 < last) value = hn::Sub(value, hn::Mul(l2, after_next[c]));
      if (t + 1 < last) value = hn::Sub(value, hn::Mul(l1, next[c]));
      after_next[c] = next[c];
      next[c] = value;
      if (t < kept) put(value, u, t - first, c);
    }
  }
}

void lanes_fit(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
               const double* u, std::size_t u_first, double* x) {
  const Tag d;
  const Vector strength = hn::Set(d, factor.strength);
  const std::size_t differences = factor.frames - order;
  for (std::size_t t = first; t < last; ++t) {
    for (std::size_t c = 0; c < columns(); ++c) {
      Vector sum = hn::Zero(d);
      for (std::size_t k = 0; k <= order; ++k) {
        if (k > t || t - k >= differences) continue;
        sum = hn::Add(sum, hn::Mul(hn::Set(d, coefficients[k]), at(u, t - k - u_first, c)));
      }
      put(hn::Sub(at(y, t, c), hn::Mul(strength, sum)), x, t - first, c);
    }
  }
}

void lanes_errors(std::size_t rows, const double* y, const double* x, const double* weight,
                  const double* caps, double* sums) {
  const Tag d;
  constexpr std::size_t axis = columns() / 3;
  for (std::size_t c = 0; c < axis; ++c) {
    const Vector cap = hn::LoadU(d, caps + c * hn::Lanes(d));
    Vector sum = hn::LoadU(d, sums + c * hn::Lanes(d));
    for (std::size_t t = 0; t < rows; ++t) {
      const Vector scale = hn::Set(d, 1 / weight[t]);
      Vector square = hn::Zero(d);
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t column = a * axis + c;
        const Vector error = hn::Mul(scale, hn::Sub(at(y, t, column), at(x, t, column)));
        square = hn::Add(square, hn::Mul(error, error));
      }
      sum = hn::Add(sum, hn::Min(square, cap));
    }
    hn::StoreU(sum, d, sums + c * hn::Lanes(d));
  }
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {

HWY_EXPORT(lanes_forward);
HWY_EXPORT(lanes_backward);
HWY_EXPORT(lanes_fit);
HWY_EXPORT(lanes_errors);

void lanes_forward(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
                   double* v, std::size_t v_first) {
  HWY_DYNAMIC_DISPATCH(lanes_forward)(factor, first, last, y, v, v_first);
}
void lanes_backward(const SharedRows& factor, std::size_t first, std::size_t kept, std::size_t last,
                    const double* v, std::size_t v_first, double* u) {
  HWY_DYNAMIC_DISPATCH(lanes_backward)(factor, first, kept, last, v, v_first, u);
}
void lanes_fit(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
               const double* u, std::size_t u_first, double* x) {
  HWY_DYNAMIC_DISPATCH(lanes_fit)(factor, first, last, y, u, u_first, x);
}
void lanes_errors(std::size_t rows, const double* y, const double* x, const double* weight,
                  const double* caps, double* sums) {
  HWY_DYNAMIC_DISPATCH(lanes_errors)(rows, y, x, weight, caps, sums);
}

}  // namespace kinemend::signal
#endif
