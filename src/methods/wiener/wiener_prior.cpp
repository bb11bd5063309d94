// Stores and reads the prior, and adapts it to other rates and to rotated channels.
#include "methods/wiener/wiener_prior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Keeps covariances positive definite when rounded to 16 bits. Chosen by hand, not swept.
constexpr double least_deviation = 1e-3;  // degrees

Tensor tensor_of(const Rows& matrix, TensorType type) {
  return {type,
          {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())},
          std::vector<double>(matrix.data(), matrix.data() + matrix.size())};
}

MatrixXd matrix_of(const Tensor& tensor) {
  return Eigen::Map<const Rows>(tensor.values.data(), static_cast<Index>(tensor.shape[0]),
                                static_cast<Index>(tensor.shape[1]));
}

std::size_t triangle(std::size_t n) { return n * (n + 1) / 2; }

// Lower triangle, row by row.
void pack(const MatrixXd& lower, double* packed) {
  for (Index r = 0; r < lower.rows(); ++r) {
    for (Index c = 0; c <= r; ++c) *packed++ = lower(r, c);
  }
}
MatrixXd unpack(const double* packed, Index n) {
  MatrixXd lower = MatrixXd::Zero(n, n);
  for (Index r = 0; r < n; ++r) {
    for (Index c = 0; c <= r; ++c) lower(r, c) = *packed++;
    lower(r, r) = std::max(lower(r, r), least_deviation);
  }
  return lower;
}

[[noreturn]] void refuse(const char* what) { throw Error(ErrorKind::unreadable_input, what); }

}  // namespace

WienerPrior with_coefficients(const WienerPrior& prior, Index coefficients) {
  const Index k = prior.coefficients();
  if (coefficients >= k) return prior;
  WienerPrior result = prior;
  result.mean.resize(prior.channels() * coefficients);
  result.basis.resize(prior.channels() * coefficients, prior.rank());
  for (Index d = 0; d < prior.channels(); ++d) {
    result.mean.segment(d * coefficients, coefficients) = prior.mean.segment(d * k, coefficients);
    result.basis.middleRows(d * coefficients, coefficients) =
        prior.basis.middleRows(d * k, coefficients);
  }
  return result;
}

WienerPrior with_turned_channels(const WienerPrior& prior, std::span<const Eigen::Matrix3d> turns) {
  WienerPrior result = prior;
  const Index k = prior.coefficients();
  for (std::size_t track = 0; track < turns.size(); ++track) {
    const Index first = 3 * static_cast<Index>(track);
    result.rest.middleRows<3>(first) = turns[track].cwiseAbs2() * prior.rest.middleRows<3>(first);
    for (Index row = 0; row < 3; ++row) {
      const Index to = (first + row) * k;
      result.mean.segment(to, k).setZero();
      result.basis.middleRows(to, k).setZero();
      for (Index column = 0; column < 3; ++column) {
        const double share = turns[track](row, column);
        const Index from = (first + column) * k;
        result.mean.segment(to, k) += share * prior.mean.segment(from, k);
        result.basis.middleRows(to, k) += share * prior.basis.middleRows(from, k);
      }
    }
  }
  return result;
}

void store_wiener_prior(const WienerPrior& prior, Model& model) {
  const auto count = prior.components.size();
  const auto rank = static_cast<std::size_t>(prior.rank());
  model.numbers["window_s"] = prior.window_s;
  model.numbers["coefficients"] = static_cast<double>(prior.coefficients());
  model.tensors["mean"] = tensor_of(prior.mean, TensorType::f32);
  model.tensors["basis"] = tensor_of(prior.basis, TensorType::f16);
  model.tensors["rest"] = tensor_of(prior.rest, TensorType::f32);
  MatrixXd weights(static_cast<Index>(count), 1);
  MatrixXd means(static_cast<Index>(count), prior.rank());
  Tensor factors{TensorType::f16, {count, triangle(rank)}, {}};
  factors.values.resize(count * triangle(rank));
  for (std::size_t c = 0; c < count; ++c) {
    const WienerPrior::Component& component = prior.components[c];
    weights(static_cast<Index>(c), 0) = component.weight;
    means.row(static_cast<Index>(c)) = component.mean.transpose();
    pack(component.covariance.llt().matrixL(), factors.values.data() + c * triangle(rank));
  }
  model.tensors["weights"] = tensor_of(weights, TensorType::f32);
  model.tensors["means"] = tensor_of(means, TensorType::f32);
  model.tensors["factors"] = std::move(factors);
}

WienerPrior wiener_prior_of(const Model& model) {
  const std::size_t channels = model.layout.channel_count();
  WienerPrior prior;
  prior.window_s = model.number("window_s");
  if (!(prior.window_s >= 0.05 && prior.window_s <= 10))
    refuse("the model's window is not between 0.05 and 10 s");
  prior.mean = matrix_of(model.tensor("mean", 2));
  prior.rest = matrix_of(model.tensor("rest", 2)).cwiseMax(0.0);
  const double k = model.number("coefficients");
  const auto coefficients = k >= 1 && k <= 1000 ? static_cast<std::size_t>(k) : 0;
  if (coefficients == 0 || model.tensor("mean", 2).shape[0] != channels * coefficients ||
      model.tensor("mean", 2).shape[1] != 1)
    refuse("the model's mean does not fit its channels and coefficients");
  if (static_cast<std::size_t>(prior.rest.rows()) != channels ||
      static_cast<std::size_t>(prior.rest.cols()) < coefficients)
    refuse("the model's variances do not fit its channels and coefficients");
  const Tensor& basis = model.tensor("basis", 2);
  const std::size_t rank = basis.shape[1];
  if (basis.shape[0] != channels * coefficients || rank < 1 || rank > basis.shape[0])
    refuse("the model's basis does not fit its channels and coefficients");
  prior.basis = matrix_of(basis);
  const Tensor& means = model.tensor("means", 2);
  const std::size_t count = means.shape[0];
  if (count == 0) refuse("the model has no component");
  const Tensor& weights = model.tensor("weights", {count, 1});
  const Tensor& factors = model.tensor("factors", {count, triangle(rank)});
  if (means.shape[1] != rank) refuse("the model's components do not fit its basis");
  for (std::size_t c = 0; c < count; ++c) {
    const MatrixXd lower =
        unpack(factors.values.data() + c * triangle(rank), static_cast<Index>(rank));
    prior.components.push_back(
        {std::max(weights.values[c], 1e-9),
         Eigen::Map<const VectorXd>(means.values.data() + c * rank, static_cast<Index>(rank)),
         lower * lower.transpose()});
  }
  return prior;
}

}  // namespace kinemend
