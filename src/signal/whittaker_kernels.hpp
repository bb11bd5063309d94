// The recursions of whittaker.hpp over rows of eight channels, compiled for each instruction set
// and chosen at run time. Products and sums are not fused, so that each instruction set gives the
// same bits.
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

}  // namespace kinemend::signal
