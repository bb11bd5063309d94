// The recursions of leave_one_out.hpp over rows of eight tracks of vectors, compiled for each
// instruction set and chosen at run time.
#pragma once

#include <cstddef>

#include "signal/whittaker_kernels.hpp"

namespace kinemend::signal {

/// The factors are of order 2.
///
/// v[t] = (D^d y)[t] - sum_k L[t, t - k] v[t - k] for differences [first, last); `v` holds those
/// from `v_first` on, which is at most first - order (or 0).
void lanes_forward(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
                   double* v, std::size_t v_first);
/// u[t] = v[t] / pivot - sum_k L[t + k, t] u[t + k] from last - 1 down to first, as if there were
/// no differences from `last` on; stored in `u`, whose first row is `first`, up to `kept`.
void lanes_backward(const SharedRows& factor, std::size_t first, std::size_t kept, std::size_t last,
                    const double* v, std::size_t v_first, double* u);
/// x[t] = y[t] - strength sum_k c[k] u[t - k] for frames [first, last), into rows of `x` from 0 on.
void lanes_fit(const SharedRows& factor, std::size_t first, std::size_t last, const double* y,
               const double* u, std::size_t u_first, double* x);
/// Sums min(|(y - x) / weight|^2, cap) of each of eight tracks over `rows` rows.
void lanes_errors(std::size_t rows, const double* y, const double* x, const double* weight,
                  const double* caps, double* sums);

}  // namespace kinemend::signal
