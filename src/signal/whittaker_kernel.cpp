// The recursions of Whittaker smoothing and the residuals of many models at once, compiled once for
// each instruction set.
#include "base/simd.hpp"
#include "signal/whittaker.hpp"
#include "signal/whittaker_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/whittaker_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinemend::signal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, block_channels>;
using Vector = hn::Vec<Tag>;

// Calls work(column) for each vector of columns of a block.
template <class Work>
HWY_INLINE void for_columns(const Work& work) {
  for (std::size_t c = 0; c < block_channels; c += hn::Lanes(Tag())) work(c);
}

// (D^d x)[t] of one vector of columns.
template <std::size_t order>
HWY_INLINE auto difference_at(const double* x, std::size_t t) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  auto sum = hn::Zero(d);
  for (std::size_t k = 0; k <= order; ++k)
    sum = hn::Add(sum, hn::Mul(hn::Set(d, c[k]), hn::LoadU(d, x + (t + k) * block_channels)));
  return sum;
}

template <std::size_t order>
HWY_INLINE void solve_shared_column(const SharedRows& factor, const double* y, double* x,
                                    double* residuals) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  const std::size_t differences = factor.frames - order, last = factor.stored - 1;
  const auto at = [](double* data, std::size_t t) { return data + t * block_channels; };
  const auto stored = [last](std::size_t t) { return t < last ? t : last; };
  const auto lower = [&](std::size_t t, std::size_t k) {
    return hn::Set(d, factor.lower[stored(t) * order + k - 1]);
  };
  auto sums = hn::Zero(d);
  for (std::size_t t = 0; t < differences; ++t) {
    auto value = difference_at<order>(y, t);
    for (std::size_t k = order; k >= 1; --k) {
      if (k > t) continue;
      value = hn::Sub(value, hn::Mul(lower(t, k), hn::LoadU(d, at(x, t - k))));
    }
    hn::StoreU(value, d, at(x, t));
    const auto scaled = hn::Mul(value, hn::Set(d, factor.inverse_diagonal[stored(t)]));
    sums = hn::Add(sums, hn::Mul(scaled, value));
  }
  for (std::size_t t = differences; t-- > 0;) {
    auto value = hn::Mul(hn::LoadU(d, at(x, t)), hn::Set(d, factor.inverse_diagonal[stored(t)]));
    for (std::size_t k = order; k >= 1; --k) {
      if (t + k >= differences) continue;
      value = hn::Sub(value, hn::Mul(lower(t + k, k), hn::LoadU(d, at(x, t + k))));
    }
    hn::StoreU(value, d, at(x, t));
  }
  // Subtracts the weighted differences from y, from the last frame to the first.
  const auto strength = hn::Set(d, factor.strength);
  for (std::size_t t = factor.frames; t-- > 0;) {
    auto sum = hn::Zero(d);
    for (std::size_t k = 0; k <= order; ++k) {
      if (k > t || t - k >= differences) continue;
      sum = hn::Add(sum, hn::Mul(hn::Set(d, c[k]), hn::LoadU(d, at(x, t - k))));
    }
    hn::StoreU(hn::Sub(hn::LoadU(d, y + t * block_channels), hn::Mul(strength, sum)), d, at(x, t));
  }
  hn::StoreU(hn::Mul(strength, sums), d, residuals);
}

void solve_shared_rows(const SharedRows& factor, const double* y, double* x, double* residuals) {
  for_columns([&](std::size_t c) {
    if (factor.order == 1) solve_shared_column<1>(factor, y + c, x + c, residuals + c);
    if (factor.order == 2) solve_shared_column<2>(factor, y + c, x + c, residuals + c);
    if (factor.order == 3) solve_shared_column<3>(factor, y + c, x + c, residuals + c);
  });
}

// Models processed together, to hide the latency of each one's recursion. For speed, not swept.
constexpr std::size_t models_at_once = 4;

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
  for_columns([&](std::size_t c) {
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
  });
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

// A[t, t - k] of the penalty: sum_u c[u] c[u + k] penalty[t - k - u].
template <std::size_t order>
HWY_INLINE auto penalty_entry(const double* penalty, const double* c, std::size_t frames,
                              std::size_t t, std::size_t k) {
  const Tag d;
  auto sum = hn::Zero(d);
  for (std::size_t u = 0; u + k <= order; ++u) {
    if (t < k + u || t - k - u >= frames - order) continue;
    sum = hn::Add(sum, hn::Mul(hn::Set(d, c[u] * c[u + k]),
                               hn::LoadU(d, penalty + (t - k - u) * block_channels)));
  }
  return sum;
}

template <std::size_t order>
HWY_INLINE void factor_column(const WeightedRows& rows, const double* weight, const double* penalty,
                              std::size_t column) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  const auto at = [column](const double* data, std::size_t t) {
    return hn::LoadU(Tag(), data + t * block_channels + column);
  };
  for (std::size_t t = 0; t < rows.frames; ++t) {
    auto pivot =
        hn::Add(at(weight, t), penalty_entry<order>(penalty + column, c.data(), rows.frames, t, 0));
    for (std::size_t k = order; k >= 1; --k) {
      if (k > t) continue;
      auto entry = penalty_entry<order>(penalty + column, c.data(), rows.frames, t, k);
      if (k == 1 && rows.coupling) entry = hn::Add(entry, at(rows.coupling, t - 1));
      for (std::size_t m = k + 1; m <= order && m <= t; ++m) {
        entry = hn::Sub(entry, hn::Mul(hn::Mul(at(rows.lower[m - 1], t), at(rows.diagonal, t - m)),
                                       at(rows.lower[m - k - 1], t - k)));
      }
      const auto before = at(rows.diagonal, t - k);
      const auto lower = hn::Div(entry, before);
      hn::StoreU(lower, d, rows.lower[k - 1] + t * block_channels + column);
      pivot = hn::Sub(pivot, hn::Mul(hn::Mul(lower, lower), before));
    }
    hn::StoreU(pivot, d, rows.diagonal + t * block_channels + column);
  }
}

void factor_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty) {
  for_columns([&](std::size_t c) {
    if (rows.order == 1) factor_column<1>(rows, weight, penalty, c);
    if (rows.order == 2) factor_column<2>(rows, weight, penalty, c);
    if (rows.order == 3) factor_column<3>(rows, weight, penalty, c);
  });
}

template <std::size_t order>
HWY_INLINE void refine_column(const WeightedRows& rows, const double* weight, const double* penalty,
                              const double* y, double* x, double* step, std::size_t column) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  const auto at = [column](const double* data, std::size_t t) {
    return hn::LoadU(Tag(), data + t * block_channels + column);
  };
  const std::size_t differences = rows.frames - order;
  // penalty D x, for the frames that the next row of (D^d)^T needs; the newest first.
  decltype(hn::Zero(d)) recent[order + 1];
  for (auto& value : recent) value = hn::Zero(d);
  for (std::size_t t = 0; t < rows.frames; ++t) {
    for (std::size_t k = order; k >= 1; --k) recent[k] = recent[k - 1];
    recent[0] = t < differences ? hn::Mul(at(penalty, t), difference_at<order>(x + column, t))
                                : hn::Zero(d);
    auto value = hn::Mul(at(weight, t), hn::Sub(at(y, t), at(x, t)));
    if (rows.coupling && t > 0)
      value =
          hn::Add(value, hn::Mul(at(rows.coupling, t - 1), hn::Sub(at(y, t - 1), at(x, t - 1))));
    if (rows.coupling && t + 1 < rows.frames)
      value = hn::Add(value, hn::Mul(at(rows.coupling, t), hn::Sub(at(y, t + 1), at(x, t + 1))));
    for (std::size_t k = 0; k <= order; ++k)
      value = hn::Sub(value, hn::Mul(hn::Set(d, c[k]), recent[k]));
    for (std::size_t k = order; k >= 1; --k) {
      if (k <= t) value = hn::Sub(value, hn::Mul(at(rows.lower[k - 1], t), at(step, t - k)));
    }
    hn::StoreU(value, d, step + t * block_channels + column);
  }
  for (std::size_t t = rows.frames; t-- > 0;) {
    auto value = hn::Div(at(step, t), at(rows.diagonal, t));
    for (std::size_t k = order; k >= 1; --k) {
      if (t + k < rows.frames)
        value = hn::Sub(value, hn::Mul(at(rows.lower[k - 1], t + k), at(step, t + k)));
    }
    hn::StoreU(value, d, step + t * block_channels + column);
    hn::StoreU(hn::Add(at(x, t), value), d, x + t * block_channels + column);
  }
}

void refine_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty,
                          const double* y, double* x, double* step) {
  for_columns([&](std::size_t c) {
    if (rows.order == 1) refine_column<1>(rows, weight, penalty, y, x, step, c);
    if (rows.order == 2) refine_column<2>(rows, weight, penalty, y, x, step, c);
    if (rows.order == 3) refine_column<3>(rows, weight, penalty, y, x, step, c);
  });
}

// Takahashi's recursion: the band of A^-1 from its factor, from the last row up. The last order + 1
// rows of it give the variance of a difference.
template <std::size_t order>
HWY_INLINE void variance_column(const WeightedRows& rows, double* variances, std::size_t column) {
  const Tag d;
  constexpr auto c = difference_coefficients(order);
  const auto at = [column](const double* data, std::size_t t) {
    return hn::LoadU(Tag(), data + t * block_channels + column);
  };
  // inverse[r][k] = A^-1[t + r, t + r + k].
  hn::Vec<Tag> inverse[order + 1][order + 1];
  for (auto& row : inverse) {
    for (auto& entry : row) entry = hn::Zero(d);
  }
  for (std::size_t t = rows.frames; t-- > 0;) {
    for (std::size_t r = order; r >= 1; --r) {
      for (std::size_t k = 0; k <= order; ++k) inverse[r][k] = inverse[r - 1][k];
    }
    const std::size_t band = rows.frames - 1 - t < order ? rows.frames - 1 - t : order;
    for (std::size_t k = order; k >= 1; --k) {
      if (k > band) continue;
      auto sum = hn::Zero(d);
      for (std::size_t m = 1; m <= order; ++m) {
        if (m > band) continue;
        sum = hn::Sub(sum, hn::Mul(at(rows.lower[m - 1], t + m),
                                   inverse[m < k ? m : k][m > k ? m - k : k - m]));
      }
      inverse[0][k] = sum;
    }
    auto sum = hn::Div(hn::Set(d, 1.0), at(rows.diagonal, t));
    for (std::size_t m = 1; m <= order; ++m) {
      if (m <= band) sum = hn::Sub(sum, hn::Mul(at(rows.lower[m - 1], t + m), inverse[0][m]));
    }
    inverse[0][0] = sum;
    if (band < order) continue;
    auto variance = hn::Zero(d);
    for (std::size_t u = 0; u <= order; ++u) {
      for (std::size_t v = u; v <= order; ++v) {
        const double factor = (u == v ? 1.0 : 2.0) * c[u] * c[v];
        variance = hn::Add(variance, hn::Mul(hn::Set(d, factor), inverse[u][v - u]));
      }
    }
    hn::StoreU(variance, d, variances + t * block_channels + column);
  }
}

void difference_variance_rows(const WeightedRows& rows, double* variances) {
  for_columns([&](std::size_t c) {
    if (rows.order == 1) variance_column<1>(rows, variances, c);
    if (rows.order == 2) variance_column<2>(rows, variances, c);
    if (rows.order == 3) variance_column<3>(rows, variances, c);
  });
}

}  // namespace kinemend::signal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::signal {

HWY_EXPORT(solve_shared_rows);
HWY_EXPORT(add_shared_residuals);
HWY_EXPORT(factor_weighted_rows);
HWY_EXPORT(refine_weighted_rows);
HWY_EXPORT(difference_variance_rows);

void solve_shared_rows(const SharedRows& factor, const double* y, double* x, double* residuals) {
  HWY_DYNAMIC_DISPATCH(solve_shared_rows)(factor, y, x, residuals);
}
void add_shared_residuals(const SharedRows* factors, std::size_t models, std::size_t first,
                          std::size_t last, const double* y, double* sums, double* before) {
  HWY_DYNAMIC_DISPATCH(add_shared_residuals)(factors, models, first, last, y, sums, before);
}
void factor_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty) {
  HWY_DYNAMIC_DISPATCH(factor_weighted_rows)(rows, weight, penalty);
}
void refine_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty,
                          const double* y, double* x, double* step) {
  HWY_DYNAMIC_DISPATCH(refine_weighted_rows)(rows, weight, penalty, y, x, step);
}
void difference_variance_rows(const WeightedRows& rows, double* variances) {
  HWY_DYNAMIC_DISPATCH(difference_variance_rows)(rows, variances);
}

}  // namespace kinemend::signal
#endif
