#include <algorithm>

#include "base/simd.hpp"
#include "signal/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/kalman_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Position of entry (i, j), i <= j, in the upper triangle of n x n, row by row.
constexpr std::size_t entry(std::size_t n, std::size_t i, std::size_t j) {
  return i * n - i * (i + 1) / 2 + j;
}

// One step of unit length: x -> A x with A the Taylor matrix of constant velocity or acceleration.
template <std::size_t n, class D>
HWY_INLINE void predict_state(D d, hn::Vec<D>* x) {
  if constexpr (n == 2) {
    x[0] = hn::Add(x[0], x[1]);
  } else if constexpr (n == 3) {
    const auto half = hn::Mul(hn::Set(d, 0.5), x[2]);
    x[0] = hn::Add(hn::Add(x[0], x[1]), half);
    x[1] = hn::Add(x[1], x[2]);
  }
}

// P -> A P A' + q Q, Q the covariance that white noise in the highest derivative builds up over one
// step.
template <std::size_t n, class D>
HWY_INLINE void predict_covariance(D d, hn::Vec<D>* p, hn::Vec<D> q) {
  if constexpr (n == 1) {
    p[0] = hn::Add(p[0], q);
  } else if constexpr (n == 2) {
    const auto cross = hn::Add(p[1], p[2]);
    p[0] = hn::Add(hn::Add(hn::Add(p[0], p[1]), cross), hn::Mul(q, hn::Set(d, 1.0 / 3)));
    p[1] = hn::Add(cross, hn::Mul(q, hn::Set(d, 0.5)));
    p[2] = hn::Add(p[2], q);
  } else {
    const auto half = hn::Set(d, 0.5);
    // Rows 0 and 1 of A P.
    const auto m00 = hn::Add(hn::Add(p[0], p[1]), hn::Mul(half, p[2]));
    const auto m01 = hn::Add(hn::Add(p[1], p[3]), hn::Mul(half, p[4]));
    const auto m02 = hn::Add(hn::Add(p[2], p[4]), hn::Mul(half, p[5]));
    const auto m11 = hn::Add(p[3], p[4]);
    const auto m12 = hn::Add(p[4], p[5]);
    const auto scaled = [&](double factor) HWY_ATTR { return hn::Mul(q, hn::Set(d, factor)); };
    p[0] = hn::Add(hn::Add(hn::Add(m00, m01), hn::Mul(half, m02)), scaled(1.0 / 20));
    p[1] = hn::Add(hn::Add(m01, m02), scaled(1.0 / 8));
    p[2] = hn::Add(m02, scaled(1.0 / 6));
    p[3] = hn::Add(hn::Add(m11, m12), scaled(1.0 / 3));
    p[4] = hn::Add(m12, scaled(1.0 / 2));
    p[5] = hn::Add(p[5], q);
  }
}

// A frame whose gains are those of the frame before.
template <std::size_t n, class D>
HWY_INLINE std::size_t settled_part(D d, const KalmanLanes& lanes, double* row, std::size_t begin,
                                    double* predicted) {
  const std::size_t channels = lanes.channels;
  std::size_t c = begin;
  for (; c + hn::Lanes(d) <= channels; c += hn::Lanes(d)) {
    hn::Vec<D> x[n];
    for (std::size_t i = 0; i < n; ++i) x[i] = hn::LoadU(d, lanes.state + i * channels + c);
    const auto innovation = hn::Sub(hn::LoadU(d, row + c), x[0]);
    if (predicted != nullptr) hn::StoreU(x[0], d, predicted + c);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = hn::Add(x[i], hn::Mul(hn::LoadU(d, lanes.gain + i * channels + c), innovation));
    }
    if (predicted == nullptr) hn::StoreU(x[0], d, row + c);
    predict_state<n>(d, x);
    for (std::size_t i = 0; i < n; ++i) hn::StoreU(x[i], d, lanes.state + i * channels + c);
  }
  return c;
}

// Any frame. `observed` holds 1 for a sample, 0 for none. Clears `settled` unless all covariances
// stay.
template <std::size_t n, class D>
HWY_INLINE std::size_t forward_part(D d, const KalmanLanes& lanes, double* row,
                                    const double* observed, double frame, std::size_t begin,
                                    double* predicted, bool& settled) {
  constexpr std::size_t entries = n * (n + 1) / 2;
  const std::size_t channels = lanes.channels;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto now = hn::Set(d, frame);
  std::size_t c = begin;
  for (; c + hn::Lanes(d) <= channels; c += hn::Lanes(d)) {
    const auto z = hn::LoadU(d, row + c);
    const auto sample = hn::Gt(hn::LoadU(d, observed + c), zero);
    auto first = hn::LoadU(d, lanes.first_frame + c);
    const auto start = hn::And(sample, hn::Gt(first, now));
    first = hn::IfThenElse(start, now, first);
    hn::StoreU(first, d, lanes.first_frame + c);
    const auto started = hn::Ge(now, first);

    hn::Vec<D> x[n];
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = hn::IfThenElse(start, i == 0 ? z : zero, hn::LoadU(d, lanes.state + i * channels + c));
    }
    const auto prior = hn::LoadU(d, lanes.prior + c);
    hn::Vec<D> old[entries];
    hn::Vec<D> p[entries];
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) {
        const std::size_t e = entry(n, i, j);
        old[e] = hn::IfThenElse(start, i == j ? prior : zero,
                                hn::LoadU(d, lanes.covariance + e * channels + c));
        p[e] = old[e];
      }
    }
    if (predicted != nullptr) hn::StoreU(x[0], d, predicted + c);

    // With a sample the filtered covariance's first row is the gain, for the measurement variance
    // is 1.
    const auto inverse = hn::Div(one, hn::Add(p[0], one));
    const auto innovation = hn::IfThenElse(sample, hn::Sub(z, x[0]), zero);
    hn::Vec<D> gain[n];
    for (std::size_t i = 0; i < n; ++i) gain[i] = hn::Mul(p[i], inverse);
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) {
        const std::size_t e = entry(n, i, j);
        p[e] = hn::IfThenElse(sample, hn::Sub(p[e], hn::Mul(gain[i], old[j])), p[e]);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = hn::Add(x[i], hn::Mul(gain[i], innovation));
      p[i] = hn::IfThenElse(sample, gain[i], p[i]);
      hn::StoreU(p[i], d, lanes.gain + i * channels + c);
    }
    hn::StoreU(hn::IfThenElse(sample, inverse, zero), d, lanes.gain + n * channels + c);
    if (predicted == nullptr) hn::StoreU(hn::IfThenElse(started, x[0], z), d, row + c);

    predict_state<n>(d, x);
    predict_covariance<n>(d, p, hn::LoadU(d, lanes.noise + c));
    auto same = sample;
    for (std::size_t e = 0; e < entries; ++e) {
      const auto tolerance = hn::Mul(hn::Set(d, 1e-13), hn::Abs(old[e]));
      same = hn::And(same, hn::Le(hn::Abs(hn::Sub(p[e], old[e])), tolerance));
    }
    for (std::size_t i = 0; i < n; ++i) hn::StoreU(x[i], d, lanes.state + i * channels + c);
    for (std::size_t e = 0; e < entries; ++e) {
      hn::StoreU(hn::IfThenElse(same, old[e], p[e]), d, lanes.covariance + e * channels + c);
    }
    settled = settled && hn::AllTrue(d, same);
  }
  return c;
}

// Writes 1 or 0 a channel; returns whether all are 1.
HWY_INLINE bool unpack_marks(const std::uint8_t* missing, std::size_t channels, double* observed) {
  bool all = true;
  for (std::size_t c = 0; c < channels; ++c) {
    observed[c] = missing[c] ? 0.0 : 1.0;
    all = all && !missing[c];
  }
  return all;
}

template <std::size_t n>
HWY_INLINE void forward_rows(KalmanLanes& lanes, const KalmanRows& rows, KalmanTrace* trace) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const std::size_t channels = lanes.channels;
  std::vector<double> observed(channels, 1.0);
  for (std::size_t t = 0; t < rows.frames; ++t) {
    double* row = rows.values + t * rows.stride;
    double* predicted = trace == nullptr ? nullptr : &trace->predicted[t * channels];
    const bool whole = rows.missing == nullptr ||
                       unpack_marks(rows.missing + t * rows.stride, channels, observed.data());
    if (lanes.settled && whole) {
      const std::size_t c = settled_part<n>(wide, lanes, row, 0, predicted);
      settled_part<n>(narrow, lanes, row, c, predicted);
    } else {
      const auto frame = static_cast<double>(rows.first_frame + t);
      lanes.settled = true;
      const std::size_t c =
          forward_part<n>(wide, lanes, row, observed.data(), frame, 0, predicted, lanes.settled);
      forward_part<n>(narrow, lanes, row, observed.data(), frame, c, predicted, lanes.settled);
      if (trace != nullptr) {
        trace->gains.insert(trace->gains.end(), lanes.gain, lanes.gain + (n + 1) * channels);
      }
    }
    if (trace != nullptr) trace->slots[t] = trace->gains.size() / ((n + 1) * channels) - 1;
  }
}

// lambda -> A' lambda, and before the first sample x -> A^-1 x.
template <std::size_t n, class D>
HWY_INLINE void step_back(D d, hn::Vec<D>* lambda, hn::Vec<D>* x) {
  if constexpr (n == 2) {
    lambda[1] = hn::Add(lambda[0], lambda[1]);
    x[0] = hn::Sub(x[0], x[1]);
  } else if constexpr (n == 3) {
    const auto half = hn::Set(d, 0.5);
    lambda[2] = hn::Add(hn::Add(hn::Mul(half, lambda[0]), lambda[1]), lambda[2]);
    lambda[1] = hn::Add(lambda[0], lambda[1]);
    x[0] = hn::Add(hn::Sub(x[0], x[1]), hn::Mul(half, x[2]));
    x[1] = hn::Sub(x[1], x[2]);
  }
}

// With f the position's row of the filtered covariance: smoothed = filtered - f lambda; a sample
// then takes innovation / variance + f lambda off lambda[0]. `adjoint` holds lambda, `state` the
// smoothed state at and before the first sample.
template <std::size_t n, class D>
HWY_INLINE std::size_t backward_part(D d, const KalmanLanes& lanes, double* row,
                                     const double* gains, const double* predicted, double frame,
                                     std::size_t begin, double* adjoint) {
  const std::size_t channels = lanes.channels;
  const auto zero = hn::Zero(d);
  const auto now = hn::Set(d, frame);
  std::size_t c = begin;
  for (; c + hn::Lanes(d) <= channels; c += hn::Lanes(d)) {
    const auto z = hn::LoadU(d, row + c);
    const auto first = hn::LoadU(d, lanes.first_frame + c);
    const auto inverse = hn::LoadU(d, gains + n * channels + c);
    const auto sample = hn::Gt(inverse, zero);
    const auto ahead = hn::LoadU(d, predicted + c);
    const auto innovation = hn::IfThenElse(sample, hn::Sub(z, ahead), zero);
    hn::Vec<D> lambda[n];
    auto pull = zero;
    for (std::size_t i = 0; i < n; ++i) {
      lambda[i] = hn::LoadU(d, adjoint + i * channels + c);
      pull = hn::Add(pull, hn::Mul(hn::LoadU(d, gains + i * channels + c), lambda[i]));
    }
    const auto filtered = hn::Add(ahead, hn::Mul(hn::LoadU(d, gains + c), innovation));
    const auto smoothed = hn::Sub(filtered, pull);
    const auto taken = hn::IfThenElse(sample, hn::Add(hn::Mul(inverse, innovation), pull), zero);
    lambda[0] = hn::Sub(lambda[0], taken);

    hn::Vec<D> x[n];
    const auto starts = hn::Eq(now, first);
    const auto prior = hn::LoadU(d, lanes.prior + c);
    for (std::size_t i = 0; i < n; ++i) {
      const auto at_start = i == 0 ? smoothed : hn::Sub(zero, hn::Mul(prior, lambda[i]));
      x[i] = hn::IfThenElse(starts, at_start, hn::LoadU(d, lanes.state + i * channels + c));
    }
    auto out = hn::IfThenElse(hn::Ge(now, first), smoothed, x[0]);
    out = hn::IfThenElse(hn::Gt(first, hn::Set(d, 1e300)), z, out);
    hn::StoreU(out, d, row + c);
    step_back<n>(d, lambda, x);
    for (std::size_t i = 0; i < n; ++i) {
      hn::StoreU(lambda[i], d, adjoint + i * channels + c);
      hn::StoreU(x[i], d, lanes.state + i * channels + c);
    }
  }
  return c;
}

template <std::size_t n>
HWY_INLINE void backward_rows(const KalmanLanes& lanes, const KalmanRows& rows,
                              const KalmanTrace& trace) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> narrow;
  const std::size_t channels = lanes.channels;
  std::vector<double> adjoint(n * channels, 0.0);
  std::fill(lanes.state, lanes.state + n * channels, 0.0);
  for (std::size_t t = rows.frames; t-- > 0;) {
    double* row = rows.values + t * rows.stride;
    const double* gains = &trace.gains[trace.slots[t] * (n + 1) * channels];
    const double* predicted = &trace.predicted[t * channels];
    const auto frame = static_cast<double>(rows.first_frame + t);
    const std::size_t c =
        backward_part<n>(wide, lanes, row, gains, predicted, frame, 0, adjoint.data());
    backward_part<n>(narrow, lanes, row, gains, predicted, frame, c, adjoint.data());
  }
}

void kalman_forward_rows(KalmanLanes& lanes, const KalmanRows& rows, KalmanTrace* trace) {
  if (lanes.components == 1) forward_rows<1>(lanes, rows, trace);
  if (lanes.components == 2) forward_rows<2>(lanes, rows, trace);
  if (lanes.components == 3) forward_rows<3>(lanes, rows, trace);
}

void kalman_backward_rows(const KalmanLanes& lanes, const KalmanRows& rows,
                          const KalmanTrace& trace) {
  if (lanes.components == 1) backward_rows<1>(lanes, rows, trace);
  if (lanes.components == 2) backward_rows<2>(lanes, rows, trace);
  if (lanes.components == 3) backward_rows<3>(lanes, rows, trace);
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {
HWY_EXPORT(kalman_forward_rows);
HWY_EXPORT(kalman_backward_rows);
void kalman_forward_rows(KalmanLanes& lanes, const KalmanRows& rows, KalmanTrace* trace) {
  HWY_DYNAMIC_DISPATCH(kalman_forward_rows)(lanes, rows, trace);
}
void kalman_backward_rows(const KalmanLanes& lanes, const KalmanRows& rows,
                          const KalmanTrace& trace) {
  HWY_DYNAMIC_DISPATCH(kalman_backward_rows)(lanes, rows, trace);
}
}  // namespace kinemend::signal
#endif
