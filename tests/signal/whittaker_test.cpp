// Tests of the banded solvers of the Whittaker smoother, against dense linear algebra.
#include "signal/whittaker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"

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
      const Eigen::MatrixXd inverse = test::inverse(a);
      EXPECT_NEAR(factor.log_determinant, std::log(test::determinant(a)),
                  1e-9 * std::fabs(std::log(test::determinant(a))) + 1e-9);
      const std::vector<double> others = weights_of_others(factor);
      for (std::size_t t = 0; t < frames; ++t) {
        EXPECT_NEAR(others[t],
                    1 - inverse(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(t)), 1e-10);
      }
      for (std::size_t c = 0; c < block_channels; ++c) {
        const Eigen::VectorXd expected = inverse * column(y, c);
        EXPECT_LT((column(x, c) - expected).norm(), 1e-9);
        EXPECT_NEAR(sums[c], column(y, c).dot(column(y, c) - expected), 1e-9);
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
    ChannelBlock x = random_block(frames, random, -2, 2), variances(frames - order);
    WeightedSystem system(frames, order);
    ChannelBlock scratch(frames);
    system.factor(weight, penalty);
    system.refine(weight, penalty, y, x, scratch);
    system.difference_variances(variances);
    const Eigen::MatrixXd d = difference_matrix(frames, order);
    for (std::size_t c = 0; c < block_channels; ++c) {
      const Eigen::MatrixXd w = column(weight, c).asDiagonal();
      const Eigen::MatrixXd p = column(penalty, c).asDiagonal();
      const Eigen::MatrixXd inverse = test::inverse(w + d.transpose() * p * d);
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

// Adds a polynomial that differences of this order remove.
ChannelBlock with_trend(ChannelBlock y, std::size_t order) {
  for (std::size_t t = 0; t < y.frames; ++t) {
    double trend = 1e5;
    if (order > 1) trend += 20 * static_cast<double>(t);
    for (std::size_t c = 0; c < block_channels; ++c) y(t, c) += trend;
  }
  return y;
}

double largest_difference(const ChannelBlock& a, const ChannelBlock& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, std::fabs(a.values[i] - b.values[i]));
  return largest;
}

TEST_P(WhittakerOrder, LargeTrendsCostTheStrongestSmootherNoDigits) {
  const std::size_t order = GetParam(), frames = 4000;
  const double strength = 1e10;
  Random random(3);
  const ChannelBlock noise = random_block(frames, random, -1, 1), y = with_trend(noise, order);
  const SharedFactor factor = factor_shared(frames, order, strength);
  ChannelBlock alone(frames), shared(frames);
  const BlockRow expected = solve_shared(factor, noise, alone),
                 sums = solve_shared(factor, y, shared);
  EXPECT_LT(largest_difference(shared, with_trend(alone, order)), 1e-5);
  for (std::size_t c = 0; c < block_channels; ++c)
    EXPECT_NEAR(sums[c] / expected[c], 1, 1e-8) << "channel " << c;

  const ChannelBlock weight(frames, 1), penalty(frames - order, strength);
  ChannelBlock weighted = y;
  WeightedSystem system(frames, order);
  ChannelBlock scratch(frames);
  system.factor(weight, penalty);
  for (int round = 0; round < 2; ++round) system.refine(weight, penalty, y, weighted, scratch);
  EXPECT_LT(largest_difference(weighted, shared), 1e-4);
}

// Rows of a factor are stored only until they settle.
TEST_P(WhittakerOrder, FactorOfALongTakeIsThatOfAShortOneContinued) {
  const std::size_t order = GetParam();
  const double strength = strength_of_cutoff(0.02, order);
  const SharedFactor factor = factor_shared(200000, order, strength);
  EXPECT_LT(factor.inverse_diagonal.size(), 2000U);
  Random random(4);
  const ChannelBlock y = random_block(6000, random, -1, 1);
  ChannelBlock x(6000);
  const SharedFactor shorter = factor_shared(6000, order, strength);
  solve_shared(shorter, y, x);
  // The residual of the equations: y - x - strength D^T D x.
  const auto c = difference_coefficients(order);
  for (std::size_t t = 3000; t < 3100; ++t) {
    double left = y(t, 0) - x(t, 0);
    for (std::size_t k = 0; k <= order; ++k) {
      double difference = 0;
      for (std::size_t m = 0; m <= order; ++m) difference += c[m] * x(t - k + m, 0);
      left -= strength * c[k] * difference;
    }
    EXPECT_NEAR(left, 0, 1e-11 * strength + 1e-9) << "frame " << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, WhittakerOrder, testing::Values(1, 2, 3));

TEST(SharedResiduals, AreThoseOfTheSolutions) {
  Random random(11);
  for (const std::size_t frames : {5, 40, 1300}) {
    const ChannelBlock y = random_block(frames, random, -20, 20);
    std::vector<SharedFactor> factors;
    for (const std::size_t order : {1, 2, 3}) {
      for (const double strength : {0.1, 3.0, 40.0, 1e3, 1e5, 1e8})
        factors.push_back(factor_shared(frames, order, strength));
    }
    const std::vector<BlockRow> residuals = shared_residuals(factors, y);
    ASSERT_EQ(residuals.size(), factors.size());
    ChannelBlock x(frames);
    for (std::size_t m = 0; m < factors.size(); ++m)
      EXPECT_EQ(residuals[m], solve_shared(factors[m], y, x)) << frames << " " << m;
  }
}

}  // namespace
}  // namespace kinemend::signal
