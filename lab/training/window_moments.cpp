// Adds windows up, finds their leading directions, and cross-validates what lies outside of these.
#include "lab/training/window_moments.hpp"

#include "methods/prior/window_bases.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// n: mean squares outside the directions.
VectorXd outside(const MatrixXd& moments, const MatrixXd& vectors) {
  const MatrixXd image = moments * vectors;
  const MatrixXd inner = vectors.transpose() * image;
  return moments.diagonal() - 2 * image.cwiseProduct(vectors).rowwise().sum() +
         (vectors * inner).cwiseProduct(vectors).rowwise().sum();
}

}  // namespace

WindowMoments::WindowMoments(Index size)
    : sum_(VectorXd::Zero(size)), squares_(MatrixXd::Zero(size, size)) {}

void WindowMoments::add(const MatrixXd& windows, double weight) {
  weight_ += weight * static_cast<double>(windows.cols());
  sum_ += weight * windows.rowwise().sum();
  squares_.selfadjointView<Eigen::Lower>().rankUpdate(windows, weight);
}

void WindowMoments::add(const WindowMoments& other) {
  weight_ += other.weight_;
  sum_ += other.sum_;
  squares_ += other.squares_;
}

MatrixXd WindowMoments::about(const VectorXd& centre) const {
  MatrixXd result = squares_.selfadjointView<Eigen::Lower>();
  const VectorXd mine = mean();
  result /= weight_;
  result += (mine - centre) * (mine - centre).transpose() - mine * mine.transpose();
  return result;
}

Directions leading_directions(const MatrixXd& covariance, Index rank) {
  const auto size = static_cast<std::size_t>(covariance.rows());
  const LeadingEigenvectors leading = leading_eigenvectors(
      {covariance.data(), size * size}, size, {1, static_cast<std::size_t>(rank), 1e-7});
  const auto found = static_cast<Index>(leading.values.size());
  return {Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
              leading.vectors.data(), covariance.rows(), found),
          Eigen::Map<const VectorXd>(leading.values.data(), found)};
}

VectorXd cross_validated_rest(const WindowMoments& half, const WindowMoments& other_half,
                              Index rank) {
  const auto left = [&](const WindowMoments& learned, const WindowMoments& held) {
    const Directions directions = leading_directions(learned.covariance(), rank);
    return outside(held.about(learned.mean()), directions.vectors);
  };
  return 0.5 * (left(half, other_half) + left(other_half, half));
}

}  // namespace kinemend
