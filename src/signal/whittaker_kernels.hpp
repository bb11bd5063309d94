#pragma once

#include <cstddef>

/// The recursions of whittaker.hpp over rows of eight channels, compiled for each instruction set
/// and chosen at run time. Products and sums stay apart, so that each instruction set gives the
/// same bits.
namespace kinemend::signal {

void solve_shared_rows(const double* lower, const double* inverse_diagonal, std::size_t order,
                       std::size_t frames, const double* y, double* x, double* product_sums);

struct WeightedRows {
  std::size_t frames;
  std::size_t order;
  double* diagonal;    ///< F x 8
  double* lower[3];    ///< order of F x 8
  double* inverse[4];  ///< order + 1 of F x 8
};
void factor_weighted_rows(const WeightedRows& rows, const double* weight, const double* penalty);
void solve_weighted_rows(const WeightedRows& rows, const double* weight, const double* y,
                         double* x);
void invert_weighted_rows(const WeightedRows& rows);
void difference_variance_rows(const WeightedRows& rows, double* variances);

}  // namespace kinemend::signal
