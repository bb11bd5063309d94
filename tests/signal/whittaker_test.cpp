// The banded solvers of the Whittaker smoother, against dense linear algebra.
#include "signal/whittaker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "kinemend/random.hpp"

namespace kinemend::signal {
namespace {

ChannelBlock random_block(std::size_t frames, Random& random, double low, double high) {
  ChannelBlock block(frames);
  for (double& value : block.values) value = random.uniform(low, high);
  return block;
}

Eigen::MatrixXd difference_matrix(std::size_t frames, std::size_t order) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(frames),
                                                static_cast<Eigen::Index>(frames));
  for (std::size_t i = 0; i < order; ++i) {
    const Eigen::Index rows = d.rows() - 1;
    d = (d.bottomRows(rows) - d.topRows(rows)).eval();
  }
  return d;
}

Eigen::VectorXd column(const ChannelBlock& block, std::size_t channel) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(block.frames));
  for (std::size_t t = 0; t < block.frames; ++t)
    values(static_cast<Eigen::Index>(t)) = block(t, channel);
  return values;
}

class WhittakerOrder : public testing::TestWithParam<std::size_t> {};

TEST_P(WhittakerOrder, SharedSolutionIsThatOfTheDenseSystem) {
  const std::size_t order = GetParam();
  Random random(1);
  for (const std::size_t frames : {order + 1, order + 2, std::size_t{7}, std::size_t{40}}) {
    for (const double strength : {0.01, 1.0, 300.0}) {
      const ChannelBlock y = random_block(frames, random, -2, 2);
      ChannelBlock x(frames);
      const SharedFactor factor = factor_shared(frames, order, strength);
      const BlockRow sums = solve_shared(factor, y, x);
      const Eigen::MatrixXd d = difference_matrix(frames, order);
      const Eigen::MatrixXd a =
          Eigen::MatrixXd::Identity(d.cols(), d.cols()) + strength * d.transpose() * d;
      const Eigen::MatrixXd inverse = a.inverse();
      EXPECT_NEAR(factor.log_determinant, std::log(a.determinant()),
                  1e-9 * std::fabs(std::log(a.determinant())) + 1e-9);
      const std::vector<double> diagonal = leverages(factor);
      for (std::size_t t = 0; t < frames; ++t) {
        EXPECT_NEAR(diagonal[t],
                    inverse(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(t)), 1e-10);
      }
      for (std::size_t c = 0; c < block_channels; ++c) {
        const Eigen::VectorXd expected = inverse * column(y, c);
        EXPECT_LT((column(x, c) - expected).norm(), 1e-9);
        EXPECT_NEAR(sums[c], column(y, c).dot(expected), 1e-9);
      }
    }
  }
}

TEST_P(WhittakerOrder, WeightedSolutionAndVariancesAreThoseOfTheDenseSystem) {
  const std::size_t order = GetParam();
  Random random(2);
  for (const std::size_t frames : {order + 2, std::size_t{9}, std::size_t{33}}) {
    ChannelBlock weight = random_block(frames, random, 0.2, 3);
    if (frames > 8) weight(4, 3) = weight(5, 3) = 0;  // missing samples
    const ChannelBlock penalty = random_block(frames - order, random, 0.1, 50);
    const ChannelBlock y = random_block(frames, random, -2, 2);
    ChannelBlock x(frames), variances(frames - order);
    WeightedSystem system(frames, order);
    system.factor(weight, penalty);
    system.solve(weight, y, x);
    system.difference_variances(variances);
    const Eigen::MatrixXd d = difference_matrix(frames, order);
    for (std::size_t c = 0; c < block_channels; ++c) {
      const Eigen::MatrixXd w = column(weight, c).asDiagonal();
      const Eigen::MatrixXd p = column(penalty, c).asDiagonal();
      const Eigen::MatrixXd inverse = (w + d.transpose() * p * d).inverse();
      EXPECT_LT((column(x, c) - inverse * w * column(y, c)).norm(), 1e-8);
      EXPECT_LT((column(variances, c) - (d * inverse * d.transpose()).diagonal()).norm(), 1e-8);
    }
  }
}

TEST_P(WhittakerOrder, PassesHalfTheAmplitudeAtTheCutoff) {
  const std::size_t order = GetParam(), frames = 2000;
  const double cutoff = 0.05;
  ChannelBlock y(frames), x(frames);
  for (std::size_t t = 0; t < frames; ++t)
    y(t, 2) = std::cos(2 * 3.14159265358979 * cutoff * static_cast<double>(t));
  solve_shared(factor_shared(frames, order, strength_of_cutoff(cutoff, order)), y, x);
  for (std::size_t t = 500; t < 520; ++t) EXPECT_NEAR(x(t, 2), 0.5 * y(t, 2), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Orders, WhittakerOrder, testing::Values(1, 2, 3));

}  // namespace
}  // namespace kinemend::signal
