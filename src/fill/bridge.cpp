#include "fill/bridge.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace kinemend::fill {

namespace {

double matern(double lag, double memory) {
  const double u = std::sqrt(5.0) * std::fabs(lag) / memory;
  return (1 + u + u * u / 3) * std::exp(-u);
}

Eigen::MatrixXd covariance(std::span<const std::size_t> rows, std::span<const std::size_t> columns,
                           double memory) {
  Eigen::MatrixXd matrix(rows.size(), columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double lag = static_cast<double>(rows[r]) - static_cast<double>(columns[c]);
      matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = matern(lag, memory);
    }
  }
  return matrix;
}

}  // namespace

Bridge::Bridge(std::span<const std::size_t> beside, std::span<const std::size_t> wanted,
               double memory_frames)
    : beside_(beside.size()), weights_(beside.size() * wanted.size()) {
  // A share of noise, far below what a sample is off its neighbours, keeps the system regular.
  constexpr double noise = 1e-4;
  Eigen::MatrixXd system = covariance(beside, beside, memory_frames);
  system.diagonal().array() += noise;
  // Column-major beside x wanted is row-major wanted x beside.
  Eigen::Map<Eigen::MatrixXd>(weights_.data(), static_cast<Eigen::Index>(beside.size()),
                              static_cast<Eigen::Index>(wanted.size())) =
      system.llt().solve(covariance(beside, wanted, memory_frames));
}

std::vector<Vec3> Bridge::carry(std::span<const Vec3> errors) const {
  std::vector<Vec3> carried(weights_.size() / beside_);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    for (std::size_t k = 0; k < beside_; ++k) {
      carried[i] += weights_[i * beside_ + k] * errors[k];
    }
  }
  return carried;
}

}  // namespace kinemend::fill
