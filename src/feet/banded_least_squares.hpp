#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace kinemend::feet {

/// The unknowns x for which a sum of squares is least, where each square has neighbours only:
/// sum_i weight_i (value_i + sum_j factor_ij x_j)^2. Time and memory grow with size times band.
class BandedLeastSquares {
 public:
  struct Term {
    std::size_t unknown = 0;
    double factor = 0;
  };

  /// Unknowns of one square are at most `band` apart.
  BandedLeastSquares(std::size_t size, std::size_t band);

  void add(std::span<const Term> terms, double value, double weight);

  /// To be called once. Every unknown must have a square of its own or one that ties it to others
  /// that do, or else the result is not finite.
  std::vector<double> solve();

 private:
  double* column(std::size_t unknown) { return normal_.data() + unknown * (band_ + 1); }

  std::size_t size_, band_;
  std::vector<double> normal_;  // lower triangle by columns, diagonal first
  std::vector<double> right_;
};

}  // namespace kinemend::feet
