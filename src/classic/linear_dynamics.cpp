// Fits the dynamics, converts them to another rate, and stores them in a model.
#include "classic/linear_dynamics.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/MatrixFunctions>

#include "kinemend/error.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Chosen by hand, not swept.
constexpr double largest_growth = 0.9999;  // of a step, so that the stationary covariance is finite
constexpr double least_variance = 1e-6;    // square degrees: least measurement variance

MatrixXd symmetric(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

// The nearest covariance matrix.
MatrixXd covariance_near(const MatrixXd& matrix) {
  const SymmetricEigen eigen = symmetric_eigen(symmetric(matrix));
  const VectorXd variances = eigen.values.cwiseMax(0.0);
  return eigen.vectors * variances.asDiagonal() * eigen.vectors.transpose();
}

void make_stable(MatrixXd& transition) {
  const double growth = transition.eigenvalues().cwiseAbs().maxCoeff();
  if (growth > largest_growth) transition *= largest_growth / growth;
}

// S = A S A^T + Q by doubling: S_{k+1} = S_k + A_k S_k A_k^T, A_{k+1} = A_k^2.
MatrixXd stationary_spread(MatrixXd transition, const MatrixXd& drive) {
  MatrixXd spread = drive;
  for (int k = 0; k < 60; ++k) {
    const MatrixXd more = transition * spread * transition.transpose();
    spread += more;
    if (more.cwiseAbs().maxCoeff() <= 1e-15 * spread.cwiseAbs().maxCoeff()) break;
    transition = (transition * transition).eval();
  }
  return symmetric(spread);
}

// Eigenvalues on the negative axis and at zero have no real power.
MatrixXd with_real_powers(const MatrixXd& transition) {
  // Chosen by hand, not swept.
  constexpr double forgotten = 1e-6;  // an eigenvalue without memory
  const Eigen::EigenSolver<MatrixXd> solver(transition);
  Eigen::VectorXcd values = solver.eigenvalues();
  bool changed = false;
  for (std::complex<double>& value : values) {
    const bool is_negative = value.real() < 0 && std::abs(value.imag()) < -1e-6 * value.real();
    if (!is_negative && std::abs(value) >= forgotten) continue;
    value = forgotten;
    changed = true;
  }
  if (!changed) return transition;
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::MatrixXcd product = vectors * values.asDiagonal();
  return vectors.transpose().partialPivLu().solve(product.transpose().eval()).transpose().real();
}

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
  const Eigen::Map<const Rows> x(poses.values.data(), static_cast<Index>(poses.frames), width);
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
  before.diagonal().array() += settings.ridge * before.diagonal().array() + least_variance;
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
  dynamics.drive.topLeftCorner(k, k).diagonal().array() += least_variance;
  dynamics.spread = covariance_near(moments.bottomRightCorner(n, n));
  dynamics.spread.diagonal().array() += least_variance;
  return dynamics;
}

LinearDynamics at_rate(const LinearDynamics& dynamics, double rate_hz) {
  const double step = dynamics.rate_hz / rate_hz;
  if (std::abs(step - 1) < 1e-6) return dynamics;
  LinearDynamics result = dynamics;
  result.rate_hz = rate_hz;
  const MatrixXd one = with_real_powers(dynamics.transition);
  const MatrixXd spread = stationary_spread(dynamics.transition, dynamics.drive);
  result.transition = one.pow(step);
  result.drive =
      covariance_near(spread - result.transition * spread * result.transition.transpose());
  return result;
}

namespace {

Tensor tensor_of(const MatrixXd& matrix, std::vector<std::size_t> shape) {
  Tensor tensor{TensorType::f32, std::move(shape), std::vector<double>(matrix.size())};
  Eigen::Map<Rows>(tensor.values.data(), matrix.rows(), matrix.cols()) = matrix;
  return tensor;
}

MatrixXd square_of(const Model& model, std::string_view name, std::size_t size) {
  const Tensor& tensor = model.tensor(name, {size, size});
  return Eigen::Map<const Rows>(tensor.values.data(), static_cast<Index>(size),
                                static_cast<Index>(size));
}

VectorXd vector_of(const Model& model, std::string_view name, std::size_t size) {
  const Tensor& tensor = model.tensor(name, std::vector<std::size_t>{size});
  return Eigen::Map<const VectorXd>(tensor.values.data(), static_cast<Index>(size));
}

}  // namespace

void store_dynamics(const LinearDynamics& dynamics, Model& model) {
  const auto d = static_cast<std::size_t>(dynamics.channels());
  const auto n = static_cast<std::size_t>(dynamics.states());
  model.rate_hz = dynamics.rate_hz;
  model.numbers["order"] = static_cast<double>(dynamics.order);
  model.tensors["mean"] = tensor_of(dynamics.mean, {d});
  model.tensors["outside"] = tensor_of(dynamics.outside, {d});
  model.tensors["transition"] = tensor_of(dynamics.transition, {n, n});
  model.tensors["drive"] = tensor_of(dynamics.drive, {n, n});
  model.tensors["spread"] = tensor_of(dynamics.spread, {n, n});
  if (dynamics.basis.size() > 0) {
    model.tensors["basis"] =
        tensor_of(dynamics.basis, {d, static_cast<std::size_t>(dynamics.basis.cols())});
  }
}

LinearDynamics dynamics_of(const Model& model) {
  const std::size_t d = model.layout.channel_count();
  const double order = model.number("order");
  if (order != 1 && order != 2)
    throw Error(ErrorKind::unreadable_input, "the model's order of motion is neither 1 nor 2");
  LinearDynamics dynamics;
  dynamics.rate_hz = model.rate_hz;
  dynamics.order = static_cast<std::size_t>(order);
  dynamics.mean = vector_of(model, "mean", d);
  dynamics.outside = vector_of(model, "outside", d).cwiseMax(0.0);
  std::size_t k = d;
  if (model.tensors.contains("basis")) {
    const Tensor& basis = model.tensor("basis", 2);
    k = basis.shape[1];
    if (basis.shape[0] != d || k < 1 || k > d)
      throw Error(ErrorKind::unreadable_input, "the model's basis does not fit its channels");
    dynamics.basis =
        Eigen::Map<const Rows>(basis.values.data(), static_cast<Index>(d), static_cast<Index>(k));
  }
  const std::size_t n = k * dynamics.order;
  dynamics.transition = square_of(model, "transition", n);
  // Rounded or edited numbers become valid covariances and stable dynamics.
  make_stable(dynamics.transition);
  dynamics.drive = covariance_near(square_of(model, "drive", n));
  dynamics.spread = covariance_near(square_of(model, "spread", n));
  return dynamics;
}

}  // namespace kinemend
