#include "priors/wiener_posterior.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Component = WienerPrior::Component;

constexpr double fewest_windows = 0.2;  // that a component is adapted to

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

MixturePosterior mixture_posterior(const std::vector<Component>& components,
                                   const MatrixXd& precision, const MatrixXd& information) {
  const Index rank = precision.rows(), count = static_cast<Index>(components.size());
  MixturePosterior result;
  result.means.resize(components.size());
  result.covariances.resize(components.size());
  MatrixXd evidence(information.cols(), count);
  tbb::parallel_for(Index{0}, count, [&](Index c) {
    const Component& component = components[static_cast<std::size_t>(c)];
    const Eigen::LLT<MatrixXd> prior(component.covariance);
    const MatrixXd identity = MatrixXd::Identity(rank, rank);
    const MatrixXd inverse = prior.solve(identity);
    const Eigen::LLT<MatrixXd> posterior(inverse + precision);
    const VectorXd pull = inverse * component.mean;
    const MatrixXd b = information.colwise() + pull;
    MatrixXd& covariance = result.covariances[static_cast<std::size_t>(c)];
    MatrixXd& mean = result.means[static_cast<std::size_t>(c)];
    covariance = posterior.solve(identity);
    mean = covariance * b;
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

MixtureMoments::MixtureMoments(std::size_t components, Index rank)
    : counts_(VectorXd::Zero(static_cast<Index>(components))),
      sums_(components, VectorXd::Zero(rank)),
      squares_(components, MatrixXd::Zero(rank, rank)) {}

void MixtureMoments::add(const MixturePosterior& posterior, double weight) {
  tbb::parallel_for(std::size_t{0}, sums_.size(), [&](std::size_t c) {
    const VectorXd shares = weight * posterior.shares.row(static_cast<Index>(c)).transpose();
    const double count = shares.sum();
    if (count <= 0) return;
    const MatrixXd& means = posterior.means[c];
    counts_(static_cast<Index>(c)) += count;
    sums_[c] += means * shares;
    squares_[c].noalias() += means * shares.asDiagonal() * means.transpose();
    squares_[c] += count * posterior.covariances[c];
  });
}

std::vector<Component> MixtureMoments::adapted(const std::vector<Component>& prior,
                                               double mean_windows,
                                               double covariance_windows) const {
  std::vector<Component> result = prior;
  const double all = counts_.sum() + static_cast<double>(prior.size());
  for (std::size_t c = 0; c < prior.size(); ++c) {
    const double n = counts_(static_cast<Index>(c));
    result[c].weight = (n + 1) / all;
    if (n < fewest_windows) continue;
    const VectorXd mean = sums_[c] / n;
    const VectorXd shift = mean - prior[c].mean;
    result[c].mean = (mean_windows * prior[c].mean + sums_[c]) / (mean_windows + n);
    result[c].covariance =
        (covariance_windows * prior[c].covariance + squares_[c] - n * mean * mean.transpose() +
         mean_windows * n / (mean_windows + n) * shift * shift.transpose()) /
        (covariance_windows + n);
  }
  return result;
}

}  // namespace kinemend
