// Tests of leading eigenvectors, against a full solver.
#include "methods/prior/window_bases.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

Eigen::MatrixXd random_matrix(std::size_t rows, std::size_t columns, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd m(rows, columns);
  for (double& value : m.reshaped()) value = random.normal();
  return m;
}

// V diag(values) V^T with random orthonormal V.
Eigen::MatrixXd with_eigenvalues(const Eigen::VectorXd& values, std::uint64_t seed) {
  const auto n = values.size();
  const Eigen::MatrixXd v = test::orthonormal(random_matrix(n, n, seed));
  const Eigen::MatrixXd m = v * values.asDiagonal() * v.transpose();
  return 0.5 * (m + m.transpose());
}

LeadingEigenvectors solve(const Eigen::MatrixXd& m, const EigenvectorLimits& limits) {
  return leading_eigenvectors({m.data(), static_cast<std::size_t>(m.size())}, m.rows(), limits);
}

Eigen::MatrixXd vectors_of(const LeadingEigenvectors& found) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      found.vectors.data(), found.size, found.values.size());
}

void expect_eigenpairs(const Eigen::MatrixXd& m, const LeadingEigenvectors& found) {
  const Eigen::MatrixXd v = vectors_of(found);
  const auto k = v.cols();
  EXPECT_LT((v.transpose() * v - Eigen::MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(), 1e-12);
  const test::SymmetricEigen full = test::symmetric_eigen(m);
  for (Eigen::Index i = 0; i < k; ++i) {
    const double value = found.values[i];
    EXPECT_NEAR(value, full.values[m.rows() - 1 - i], 1e-9 * found.values[0]) << i;
    EXPECT_LT((m * v.col(i) - value * v.col(i)).norm(), 1e-9 * found.values[0]) << i;
  }
}

TEST(LeadingEigenvectors, AreThoseOfAFullSolverForSpectraOfAnyKind) {
  for (const Eigen::Index n : {1, 2, 30, 150, 400}) {
    Eigen::VectorXd steep(n), flat(n), equal = Eigen::VectorXd::Ones(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      steep[i] = std::pow(0.8, i);
      flat[i] = 1.0 - 0.5 * static_cast<double>(i) / static_cast<double>(n);
    }
    for (const Eigen::VectorXd& values : {steep, flat, equal}) {
      const Eigen::MatrixXd m = with_eigenvalues(values, 7);
      const auto found = solve(m, {.energy = 0.9});
      expect_eigenpairs(m, found);
      const double share =
          Eigen::Map<const Eigen::VectorXd>(found.values.data(), found.values.size()).sum() /
          values.sum();
      EXPECT_GE(share, 0.9 - 1e-12);
      EXPECT_LT(share - found.values.back() / values.sum(), 0.9);
    }
  }
}

TEST(LeadingEigenvectors, AreAsManyAsAskedFor) {
  Eigen::VectorXd values(200);
  for (Eigen::Index i = 0; i < 200; ++i) values[i] = 1.0 / (1.0 + static_cast<double>(i));
  const Eigen::MatrixXd m = with_eigenvalues(values, 3);
  for (const std::size_t count : {1, 10, 120, 200}) {
    const auto found = solve(m, {.count = count});
    EXPECT_EQ(found.values.size(), count);
    expect_eigenpairs(m, found);
  }
}

TEST(LeadingEigenvectors, EndWhereTheMatrixHasNoMore) {
  const Eigen::MatrixXd factor = random_matrix(90, 5, 1);
  const Eigen::MatrixXd m = factor * factor.transpose();
  const auto found = solve(m, {.energy = 1.0});
  EXPECT_EQ(found.values.size(), 5u);
  expect_eigenpairs(m, found);
  EXPECT_TRUE(solve(Eigen::MatrixXd::Zero(6, 6), {}).values.empty());
}

TEST(LeadingEigenvectors, PointTheWayOfTheirLargestEntry) {
  const auto found = solve(with_eigenvalues(Eigen::VectorXd::LinSpaced(40, 1, 2), 5), {.count = 6});
  const Eigen::MatrixXd v = vectors_of(found);
  for (Eigen::Index k = 0; k < 6; ++k) EXPECT_GT(v.col(k).maxCoeff(), -v.col(k).minCoeff());
}

}  // namespace
}  // namespace kinemend
