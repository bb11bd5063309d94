#pragma once

#include <cstddef>

/// The recursions of whittaker.hpp over rows of eight channels, compiled for each instruction set
/// and chosen at run time. Products and sums stay apart, so that each instruction set gives the
/// same bits.
namespace kinemend::signal {

struct SharedRows {
  std::size_t frames;
  std::size_t order;
  double strength;
  const double* lower;             ///< R x order
  const double* inverse_diagonal;  ///< R
  std::size_t stored;              ///< R: the last row serves all that follow
};
void solve_shared_rows(const SharedRows& factor, const double* y, double* x, double* residuals);

struct WeightedRows {
  std::size_t frames;
  std::size_t order;
  double* diagonal;    ///< F x 8
  double* lower[3];    ///< order of F x 8
  double* inverse[4];  ///< order + 1 of F x 8
};
void factor_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty);
void refine_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty,
                          const double* y, double* x, double* step);
void invert_weighted_rows(const WeightedRows& rows);
void difference_variance_rows(const WeightedRows& rows, double* variances);

}  // namespace kinemend::signal
