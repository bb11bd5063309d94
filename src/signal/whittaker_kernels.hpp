// Declares the recursions of whittaker.hpp over rows of eight channels, and of leave_one_out.hpp
// over rows of eight tracks of vectors, compiled for each instruction set and chosen at run time.
// Products and sums are not fused, so that each instruction set gives the same bits.
#pragma once

#include <cstddef>

#include "signal/whittaker.hpp"

namespace kinemend::signal {

struct SharedRows {
  std::size_t frames;
  std::size_t order;
  double strength;
  const double* lower;             ///< R x order
  const double* inverse_diagonal;  ///< R
  std::size_t stored;              ///< R: the last row serves all that follow
};
SharedRows rows_of(const SharedFactor& factor);
void solve_shared_rows(const SharedRows& factor, const double* y, double* x, double* residuals);
/// Adds the contribution of differences [first, last) to the residuals of `solve_shared_rows`,
/// without the strength, to `sums` (models x 8) of `models` factors of one order. `before` (models
/// x `largest_order` x 8) holds the recursion's last rows, the newest first: all zero at first.
void add_shared_residuals(const SharedRows* factors, std::size_t models, std::size_t first,
                          std::size_t last, const double* y, double* sums, double* before);

struct WeightedRows {
  std::size_t frames;
  std::size_t order;
  double* diagonal;                  ///< F x 8
  double* lower[3];                  ///< order of F x 8
  const double* coupling = nullptr;  ///< F x 8, as of `WeightedSystem`; nullptr: none
};
void factor_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty);
void refine_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty,
                          const double* y, double* x, double* step);
void difference_variance_rows(const WeightedRows& rows, double* variances);

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
