// Sums up the moments of neighbouring poses and solves for the transition and its drive.
#include "lab/training/linear_dynamics_fit.hpp"

#include <Eigen/Cholesky>

#include <algorithm>

#include "kinemend/error.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using PoseRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The least variance of a measurement, square degrees. Chosen by hand, not swept.
constexpr double least_measured_variance = 1e-6;

// Moments of the stacked poses -> moments of their coordinates in the subspace.
MatrixXd projected(const MatrixXd& moments, const MatrixXd& basis, Index channels) {
  if (basis.size() == 0) return moments;
  const Index blocks = moments.rows() / channels, k = basis.cols();
  MatrixXd result(blocks * k, blocks * k);
  for (Index r = 0; r < blocks; ++r) {
    for (Index c = 0; c < blocks; ++c) {
      result.block(r * k, c * k, k, k) =
          basis.transpose() * moments.block(r * channels, c * channels, channels, channels) * basis;
    }
  }
  return result;
}

// [A_1 ... A_p; I 0] for the newest poses' regression on those before.
MatrixXd companion(const MatrixXd& coefficients) {
  const Index k = coefficients.rows(), n = coefficients.cols();
  MatrixXd result = MatrixXd::Zero(n, n);
  result.topRows(k) = coefficients;
  if (n > k) result.block(k, 0, n - k, n - k).setIdentity();
  return result;
}

}  // namespace

LinearDynamicsFit::LinearDynamicsFit(std::size_t channels, std::size_t order)
    : channels_(channels), order_(order) {
  if (order < 1 || order > 2) throw Error(ErrorKind::usage, "the order of motion is 1 or 2");
  const auto size = static_cast<Index>(channels * (order + 1));
  sums_ = VectorXd::Zero(size);
  moments_ = MatrixXd::Zero(size, size);
}

void LinearDynamicsFit::add(const PoseMatrix& poses, double weight) {
  // For speed, not swept.
  constexpr std::size_t block = 256;  // windows at a time
  if (poses.channels != channels_) throw Error(ErrorKind::usage, "poses of other channels");
  if (poses.frames < order_ + 1) return;
  const auto width = static_cast<Index>(channels_);
  const Eigen::Map<const PoseRows> x(poses.values.data(), static_cast<Index>(poses.frames), width);
  if (shift_.size() == 0) shift_ = x.colwise().mean().transpose();
  const auto lags = static_cast<Index>(order_);
  const std::size_t windows = poses.frames - order_;
  for (std::size_t first = 0; first < windows; first += block) {
    const auto at = static_cast<Index>(first);
    const auto count = static_cast<Index>(std::min(block, windows - first));
    MatrixXd stacked(count, (lags + 1) * width);
    for (Index lag = 0; lag <= lags; ++lag) {
      stacked.middleCols(lag * width, width) =
          x.middleRows(at + lags - lag, count).rowwise() - shift_.transpose();
    }
    sums_ += weight * stacked.colwise().sum().transpose();
    moments_.selfadjointView<Eigen::Lower>().rankUpdate(stacked.transpose(), weight);
    weight_ += weight * static_cast<double>(count);
  }
}

MatrixXd LinearDynamicsFit::central_moments(const VectorXd& offset) const {
  const VectorXd means = sums_ / weight_;
  const VectorXd offsets = offset.replicate(static_cast<Index>(order_) + 1, 1);
  const MatrixXd moments = moments_.selfadjointView<Eigen::Lower>();
  return moments / weight_ - means * offsets.transpose() - offsets * means.transpose() +
         offsets * offsets.transpose();
}

LinearDynamics LinearDynamicsFit::finish(const LinearDynamicsSettings& settings) const {
  if (weight_ <= 0) throw Error(ErrorKind::usage, "no motion to learn from");
  const auto width = static_cast<Index>(channels_);
  const VectorXd offset = sums_.head(width) / weight_;
  MatrixXd moments = central_moments(offset);

  LinearDynamics dynamics;
  dynamics.rate_hz = settings.rate_hz;
  dynamics.order = order_;
  dynamics.mean = shift_ + offset;
  dynamics.outside = VectorXd::Zero(width);
  if (settings.directions > 0 && settings.directions < channels_) {
    const MatrixXd variances = moments.topLeftCorner(width, width);
    const SymmetricEigen eigen = symmetric_eigen(variances);
    const auto k = static_cast<Index>(settings.directions);
    dynamics.basis = eigen.vectors.rightCols(k);
    const MatrixXd left_out = eigen.vectors.leftCols(width - k);
    dynamics.outside = (left_out.cwiseAbs2() * eigen.values.head(width - k).cwiseMax(0.0));
    moments = projected(moments, dynamics.basis, width);
  }
  const Index k = dynamics.directions(), n = k * static_cast<Index>(order_);
  MatrixXd before = moments.bottomRightCorner(n, n);
  before.diagonal().array() += settings.ridge * before.diagonal().array() + least_measured_variance;
  const MatrixXd coefficients =
      before.llt().solve(moments.topRightCorner(k, n).transpose()).transpose();
  dynamics.transition = companion(coefficients);
  make_stable(dynamics.transition);
  // The residual's covariance, with the final A.
  const MatrixXd a = dynamics.transition.topRows(k);
  const MatrixXd across = a * moments.topRightCorner(k, n).transpose();
  const MatrixXd residual = moments.topLeftCorner(k, k) - across - across.transpose() +
                            a * moments.bottomRightCorner(n, n) * a.transpose();
  dynamics.drive = MatrixXd::Zero(n, n);
  dynamics.drive.topLeftCorner(k, k) = covariance_near(residual);
  dynamics.drive.topLeftCorner(k, k).diagonal().array() += least_measured_variance;
  dynamics.spread = covariance_near(moments.bottomRightCorner(n, n));
  dynamics.spread.diagonal().array() += least_measured_variance;
  return dynamics;
}

}  // namespace kinemend
