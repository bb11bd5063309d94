// Solves least-squares problems in which each square holds only neighbouring unknowns.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace kinemend::feet {

/// Finds the unknowns x that minimise a sum of squares, each of which holds only neighbouring
/// unknowns: sum_i weight_i (value_i + sum_j factor_ij x_j)^2. Time and memory grow with size times
/// band.
class BandedLeastSquares {
 public:
  struct Term {
    std::size_t unknown = 0;
    double factor = 0;
  };

  /// The unknowns of one square are at most `band` apart.
  BandedLeastSquares(std::size_t size, std::size_t band)
      : size_(size), band_(band), normal_(size * (band + 1)), right_(size) {}

  /// `terms`: unknowns in ascending order; those of factor 0 are ignored.
  template <std::size_t count>
  void add(const std::array<Term, count>& terms, double value, double weight) {
    add(std::span<const Term>(terms), value, weight);
  }
  void add(std::span<const Term> terms, double value, double weight) {
    for (std::size_t a = 0; a < terms.size(); ++a) {
      if (terms[a].factor == 0) continue;
      const double factor = weight * terms[a].factor;
      double* const own = column(terms[a].unknown);
      right_[terms[a].unknown] -= factor * value;
      for (std::size_t b = a; b < terms.size(); ++b) {
        if (terms[b].factor != 0)
          own[terms[b].unknown - terms[a].unknown] += factor * terms[b].factor;
      }
    }
  }

  /// Returns the solution; must be called only once. The result is not finite unless the squares
  /// determine every unknown.
  std::vector<double> solve() {
    // Factorises as L D L^T without pivots, because the normal matrix is positive definite.
    for (std::size_t p = 0; p < size_; ++p) {
      double* const pivot = column(p);
      const std::size_t below = std::min(band_, size_ - 1 - p);
      for (std::size_t j = 1; j <= below; ++j) {
        const double factor = pivot[j] / pivot[0];
        if (factor == 0) continue;
        right_[p + j] -= factor * right_[p];
        double* const other = column(p + j);
        for (std::size_t i = j; i <= below; ++i) other[i - j] -= factor * pivot[i];
      }
    }
    for (std::size_t p = size_; p-- > 0;) {
      const double* const pivot = column(p);
      const std::size_t below = std::min(band_, size_ - 1 - p);
      for (std::size_t j = 1; j <= below; ++j) right_[p] -= pivot[j] * right_[p + j];
      right_[p] /= pivot[0];
    }
    return std::move(right_);
  }

 private:
  double* column(std::size_t unknown) { return normal_.data() + unknown * (band_ + 1); }

  std::size_t size_, band_;
  std::vector<double> normal_;  // lower triangle by columns, diagonal first
  std::vector<double> right_;
};

}  // namespace kinemend::feet
