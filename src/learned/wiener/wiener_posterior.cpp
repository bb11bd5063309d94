// Computes means and evidence of each component and weights them.
#include "learned/wiener/wiener_posterior.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Component = WienerPrior::Component;

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

MixturePosterior mixture_posterior(const std::vector<Component>& components,
                                   const MatrixXd& precision, const MatrixXd& information) {
  const Index rank = precision.rows(), count = static_cast<Index>(components.size());
  MixturePosterior result;
  result.means.resize(components.size());
  MatrixXd evidence(information.cols(), count);
  tbb::parallel_for(Index{0}, count, [&](Index c) {
    const Component& component = components[static_cast<std::size_t>(c)];
    const Eigen::LLT<MatrixXd> prior(component.covariance);
    const MatrixXd inverse = prior.solve(MatrixXd::Identity(rank, rank));
    const Eigen::LLT<MatrixXd> posterior(inverse + precision);
    const VectorXd pull = inverse * component.mean;
    const MatrixXd b = information.colwise() + pull;
    MatrixXd& mean = result.means[static_cast<std::size_t>(c)];
    mean = posterior.solve(b);
    const double same =
        std::log(component.weight) -
        0.5 * (log_determinant(prior) + log_determinant(posterior) + pull.dot(component.mean));
    evidence.col(c) =
        (same + 0.5 * b.cwiseProduct(mean).colwise().sum().transpose().array()).matrix();
  });
  for (Index w = 0; w < evidence.rows(); ++w) {
    evidence.row(w) = (evidence.row(w).array() - evidence.row(w).maxCoeff()).exp();
    evidence.row(w) /= evidence.row(w).sum();
  }
  result.shares = evidence.transpose();
  return result;
}

MatrixXd MixturePosterior::mean() const {
  MatrixXd result = MatrixXd::Zero(means[0].rows(), means[0].cols());
  for (std::size_t c = 0; c < means.size(); ++c)
    result += means[c] * shares.row(static_cast<Index>(c)).asDiagonal();
  return result;
}

}  // namespace kinemend
