// Computes means and evidence of each component and weights them.
#include "methods/wiener/wiener_posterior.hpp"

#include <Eigen/Cholesky>

#include "base/parallel.hpp"
#include "base/portable.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Component = WienerPrior::Component;

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT()
                 .diagonal()
                 .array()
                 .unaryExpr([](double x) { return portable::log(x); })
                 .sum();
}

}  // namespace

MixturePosterior mixture_posterior(const std::vector<Component>& components,
                                   const MatrixXd& precision, const MatrixXd& information) {
  const Index rank = precision.rows(), count = static_cast<Index>(components.size());
  MixturePosterior result;
  result.means.resize(components.size());
  MatrixXd evidence(information.cols(), count);
  for_each_index(components.size(), [&](std::size_t number) {
    const Component& component = components[number];
    const Eigen::LLT<MatrixXd> prior(component.covariance);
    const MatrixXd inverse = prior.solve(MatrixXd::Identity(rank, rank));
    const Eigen::LLT<MatrixXd> posterior(inverse + precision);
    const VectorXd pull = inverse * component.mean;
    const MatrixXd b = information.colwise() + pull;
    MatrixXd& mean = result.means[number];
    mean = posterior.solve(b);
    const double same =
        portable::log(component.weight) -
        0.5 * (log_determinant(prior) + log_determinant(posterior) + pull.dot(component.mean));
    evidence.col(static_cast<Index>(number)) =
        (same + 0.5 * b.cwiseProduct(mean).colwise().sum().transpose().array()).matrix();
  });
  for (Index w = 0; w < evidence.rows(); ++w) {
    evidence.row(w) =
        (evidence.row(w).array() - evidence.row(w).maxCoeff()).unaryExpr([](double x) {
          return portable::exp(x);
        });
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
