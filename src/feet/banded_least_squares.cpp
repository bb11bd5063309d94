// Factorises the banded normal matrix and solves for the unknowns.
#include "feet/banded_least_squares.hpp"

#include <algorithm>
#include <utility>

namespace kinemend::feet {

BandedLeastSquares::BandedLeastSquares(std::size_t size, std::size_t band)
    : size_(size), band_(band), normal_(size * (band + 1)), right_(size) {}

// Factorises as L D L^T without pivots, because the normal matrix is positive definite.
std::vector<double> BandedLeastSquares::solve() {
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

}  // namespace kinemend::feet
