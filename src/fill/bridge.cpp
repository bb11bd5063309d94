// Weights the errors beside a gap by a Gaussian process.
#include "fill/bridge.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/portable.hpp"

namespace kinemend::fill {

namespace {

// These and the memories were chosen on the takes that docs/methods/fill.md names.
// The slow part's share of the errors' variance, and its memory relative to the fast part's.
constexpr double slow_share = 0.4;
constexpr double slow_memory = 6;
// The noise variance of a sample next to the gap, as a share of the errors' variance.
constexpr double end_noise = 1e-5;

double covariance(double lag, double memory) {
  const double u = std::sqrt(5.0) * lag / memory;
  const double v = std::sqrt(3.0) * lag / (slow_memory * memory);
  return (1 - slow_share) * (1 + u + u * u / 3) * portable::exp(-u) +
         slow_share * (1 + v) * portable::exp(-v);
}

// `by_lag[k]` is the covariance of errors k frames apart.
Eigen::MatrixXd covariances(std::span<const std::size_t> rows, std::span<const std::size_t> columns,
                            const std::vector<double>& by_lag) {
  Eigen::MatrixXd matrix(rows.size(), columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::size_t lag = rows[r] > columns[c] ? rows[r] - columns[c] : columns[c] - rows[r];
      matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = by_lag[lag];
    }
  }
  return matrix;
}

}  // namespace

Bridge::Bridge(std::span<const std::size_t> beside, FrameSpan span,
               std::span<const std::size_t> wanted, double frame_rate_hz, const Settings& settings)
    : wanted_(wanted.size()), beside_(beside.size()), weights_(beside.size() * wanted.size()) {
  if (weights_.empty()) return;
  const double memory = settings.memory_s * frame_rate_hz;
  const std::size_t first = std::min(beside.front(), span.first);
  std::vector<double> by_lag(std::max(beside.back(), span.last) - first + 1);
  for (std::size_t lag = 0; lag < by_lag.size(); ++lag) {
    by_lag[lag] = covariance(static_cast<double>(lag), memory);
  }
  Eigen::MatrixXd system = covariances(beside, beside, by_lag);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const bool is_end = beside[i] + 1 == span.first || beside[i] == span.last + 1;
    system.diagonal()[static_cast<Eigen::Index>(i)] += is_end ? end_noise : settings.noise;
  }
  // Column-major beside x wanted is row-major wanted x beside.
  Eigen::Map<Eigen::MatrixXd>(weights_.data(), static_cast<Eigen::Index>(beside.size()),
                              static_cast<Eigen::Index>(wanted.size())) =
      system.llt().solve(covariances(beside, wanted, by_lag));
}

std::vector<Vec3> Bridge::carry(std::span<const Vec3> errors) const {
  std::vector<Vec3> carried(wanted_);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    for (std::size_t k = 0; k < beside_; ++k) {
      carried[i] += weights_[i * beside_ + k] * errors[k];
    }
  }
  return carried;
}

}  // namespace kinemend::fill
