// Clusters the points by k-means and refines the clusters by expectation maximisation.
#include "lab/training/mixture_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "base/portable.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Component = WienerPrior::Component;

// Leading coefficients by which windows are clustered at first, and rounds of that. Chosen by hand,
// not swept.
constexpr Index clustering_rows = 30;
constexpr int clustering_rounds = 15;
constexpr double least_pooled_variance = 1e-7;  // square degrees
constexpr double least_scale = 0.02;            // of the pooled covariance

// W: the nearest centre of each column.
std::vector<Index> nearest(const MatrixXd& points, const MatrixXd& centres) {
  const MatrixXd distances =
      (-2 * centres.transpose() * points).colwise() + centres.colwise().squaredNorm().transpose();
  std::vector<Index> result(static_cast<std::size_t>(points.cols()));
  for (Index w = 0; w < points.cols(); ++w)
    distances.col(w).minCoeff(&result[static_cast<std::size_t>(w)]);
  return result;
}

// k-means from centres of k-means++. W: the cluster of each column.
std::vector<Index> clusters(const MatrixXd& points, Index count, std::uint64_t seed) {
  Random random(seed);
  MatrixXd centres(points.rows(), count);
  const auto pick = [&](const VectorXd& weights) {
    double target = random.uniform() * weights.sum();
    for (Index w = 0; w + 1 < weights.size(); ++w) {
      target -= weights(w);
      if (target <= 0) return w;
    }
    return weights.size() - 1;
  };
  VectorXd distances = VectorXd::Ones(points.cols());
  for (Index c = 0; c < count; ++c) {
    centres.col(c) = points.col(pick(distances));
    const VectorXd now = (points.colwise() - centres.col(c)).colwise().squaredNorm();
    distances = c == 0 ? now : distances.cwiseMin(now);
  }
  std::vector<Index> labels;
  for (int round = 0; round < clustering_rounds; ++round) {
    labels = nearest(points, centres);
    MatrixXd sums = MatrixXd::Zero(points.rows(), count);
    VectorXd sizes = VectorXd::Zero(count);
    for (Index w = 0; w < points.cols(); ++w) {
      const Index label = labels[static_cast<std::size_t>(w)];
      sums.col(label) += points.col(w);
      sizes(label) += 1;
    }
    for (Index c = 0; c < count; ++c) {
      if (sizes(c) > 0) centres.col(c) = sums.col(c) / sizes(c);
    }
  }
  return labels;
}

struct Scatter {
  double points = 0;
  VectorXd mean;
  MatrixXd sum;  // of squares about the mean
};

Scatter scatter_of(const MatrixXd& points, const VectorXd& shares) {
  Scatter result;
  result.points = shares.sum();
  result.mean = points * shares / std::max(result.points, 1e-12);
  const MatrixXd spread = (points.colwise() - result.mean) * shares.cwiseSqrt().asDiagonal();
  result.sum = MatrixXd::Zero(points.rows(), points.rows());
  result.sum.selfadjointView<Eigen::Lower>().rankUpdate(spread);
  result.sum = result.sum.selfadjointView<Eigen::Lower>();
  return result;
}

std::vector<Component> maximised(const MatrixXd& points, const MatrixXd& shares, double pooling) {
  const Index rows = points.rows();
  std::vector<Scatter> scatters;
  MatrixXd pooled = MatrixXd::Zero(rows, rows);
  for (Index c = 0; c < shares.cols(); ++c) {
    scatters.push_back(scatter_of(points, shares.col(c)));
    pooled += scatters.back().sum;
  }
  pooled /= static_cast<double>(points.cols());
  pooled.diagonal().array() += least_pooled_variance;
  const Eigen::LLT<MatrixXd> pooled_factor(pooled);
  std::vector<Component> components;
  for (Scatter& scatter : scatters) {
    if (scatter.points < 1) continue;
    const double scale =
        pooled_factor.solve(scatter.sum).trace() / (scatter.points * static_cast<double>(rows));
    MatrixXd covariance = (scatter.sum + pooling * std::max(scale, least_scale) * pooled) /
                          (scatter.points + pooling);
    components.push_back({scatter.points / static_cast<double>(points.cols()),
                          std::move(scatter.mean), std::move(covariance)});
  }
  return components;
}

// W x C: the probability of each component.
MatrixXd shares_of(const MatrixXd& points, const std::vector<Component>& components) {
  MatrixXd shares(points.cols(), static_cast<Index>(components.size()));
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Eigen::LLT<MatrixXd> factor(components[c].covariance);
    const MatrixXd white = factor.matrixL().solve(points.colwise() - components[c].mean);
    const double log_root = factor.matrixLLT()
                                .diagonal()
                                .array()
                                .unaryExpr([](double x) { return portable::log(x); })
                                .sum();
    shares.col(static_cast<Index>(c)) = (portable::log(components[c].weight) - log_root -
                                         0.5 * white.colwise().squaredNorm().transpose().array())
                                            .matrix();
  }
  for (Index w = 0; w < shares.rows(); ++w) {
    shares.row(w) = (shares.row(w).array() - shares.row(w).maxCoeff()).unaryExpr([](double x) {
      return portable::exp(x);
    });
    shares.row(w) /= shares.row(w).sum();
  }
  return shares;
}

MixtureState after_clustering(const MatrixXd& points, const MixtureSettings& settings) {
  const Index count = std::clamp<Index>(static_cast<Index>(settings.components), 1, points.cols());
  const std::vector<Index> labels =
      clusters(points.topRows(std::min(points.rows(), clustering_rows)), count, settings.seed);
  MatrixXd shares = MatrixXd::Zero(points.cols(), count);
  for (Index w = 0; w < points.cols(); ++w) shares(w, labels[static_cast<std::size_t>(w)]) = 1;
  return {0, maximised(points, shares, settings.pooling)};
}

}  // namespace

std::vector<Component> fit_mixture(const MatrixXd& points, const MixtureSettings& settings,
                                   const std::function<void(const MixtureState&)>& after_each,
                                   const MixtureState* start) {
  MixtureState state = start != nullptr ? *start : after_clustering(points, settings);
  while (state.rounds < settings.rounds && state.components.size() > 1) {
    state.components = maximised(points, shares_of(points, state.components), settings.pooling);
    ++state.rounds;
    if (after_each) after_each(state);
  }
  return state.components;
}

}  // namespace kinemend
