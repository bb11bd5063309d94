// Solves the regression for each stiffness.
#include "fill/ridge.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace kinemend::fill {

std::vector<Rows> ridge_regression(const Rows& sums, const Rows& inputs,
                                   std::span<const double> stiffness) {
  const Eigen::Index width = inputs.cols();
  const double n = std::max(sums(0, 0), 1.0);
  const Eigen::RowVectorXd mean = sums.row(0) / n;
  const Eigen::MatrixXd centred = sums - n * mean.transpose() * mean;
  const Rows deviations = inputs.rowwise() - mean.segment(1, width);
  std::vector<Rows> predictions;
  for (const double stiff : stiffness) {
    Rows outputs = mean.tail(3).replicate(inputs.rows(), 1);
    if (std::isfinite(stiff)) {
      Eigen::MatrixXd system = centred.block(1, 1, width, width);
      system.diagonal().array() += n * stiff * stiff;
      outputs.noalias() += deviations * system.ldlt().solve(centred.block(1, width + 1, width, 3));
    }
    predictions.push_back(std::move(outputs));
  }
  return predictions;
}

}  // namespace kinemend::fill
