// Tests of smoothing by evidence: the marginal likelihood against its dense formula, and the
// adaptive smoother on its intended signals.
#include "signal/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::signal {
namespace {

// -2 log likelihood of y under the model, in the space of its differences: D y ~ N(0, s (D D^T + I
// / strength)).
double dense_misfit(const Eigen::VectorXd& y, const SmoothingModel& model, double variance) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Identity(y.size(), y.size());
  for (std::size_t i = 0; i < model.order; ++i) {
    d = (d.bottomRows(d.rows() - 1) - d.topRows(d.rows() - 1)).eval();
  }
  const Eigen::MatrixXd covariance =
      variance *
      (d * d.transpose() + Eigen::MatrixXd::Identity(d.rows(), d.rows()) / model.strength);
  const Eigen::VectorXd dy = d * y;
  return dy.dot(test::solve_symmetric(covariance, dy).col(0)) + test::log_determinant(covariance);
}

PoseMatrix random_walks(std::size_t frames, std::size_t channels, Random& random) {
  PoseMatrix matrix(frames, channels);
  for (std::size_t c = 0; c < channels; ++c) {
    double level = 0, slope = 0;
    for (std::size_t t = 0; t < frames; ++t) {
      slope += 0.05 * static_cast<double>(c % 4) * random.normal();
      level += slope + 0.1 * random.normal();
      matrix(t, c) = level + 0.5 * random.normal();
    }
  }
  return matrix;
}

TEST(Evidence, ChoosesTheModelOfLargestLikelihood) {
  Random random(3);
  const std::size_t frames = 60, channels = 11;
  const PoseMatrix measured = random_walks(frames, channels, random);
  const std::vector<double> variance(channels, 0.25);
  const ModelGrid grid(frames, 60);
  const std::vector<std::size_t> chosen = most_likely_models(measured, variance, grid);
  ASSERT_EQ(chosen.size(), channels);
  for (std::size_t c = 0; c < channels; ++c) {
    Eigen::VectorXd y(static_cast<Eigen::Index>(frames));
    for (std::size_t t = 0; t < frames; ++t) y(static_cast<Eigen::Index>(t)) = measured(t, c);
    // Models of different orders explain different numbers of differences, so only models of one
    // order are compared.
    const double own = dense_misfit(y, grid.models()[chosen[c]], variance[c]);
    for (const SmoothingModel& model : grid.models()) {
      if (model.order != grid.models()[chosen[c]].order) continue;
      EXPECT_GE(dense_misfit(y, model, variance[c]), own - 1e-6) << "channel " << c;
    }
  }
}

TEST(Evidence, ChannelsOfAGroupShareTheirModel) {
  Random random(4);
  const PoseMatrix matrix = random_walks(80, 12, random);
  const ModelGrid grid(80, 60);
  const auto chosen = most_likely_models(matrix, std::vector<double>(12, 0.25), grid, 3);
  for (std::size_t c = 0; c < 12; ++c) EXPECT_EQ(chosen[c], chosen[c - c % 3]);
}

TEST(Evidence, AChannelDoesNotDependOnItsNeighbours) {
  Random random(5);
  const PoseMatrix all = random_walks(70, 8, random);
  const std::vector<double> variance(8, 0.25);
  const ModelGrid grid(70, 60);
  const std::vector<std::size_t> channels{0, 1, 2, 3, 4, 5, 6, 7}, fourth{4};
  ChannelBlock together = gather(all, channels), alone = gather(all, fourth);
  const auto models = most_likely_models(together, variance, grid);
  const auto own = most_likely_models(alone, std::span(variance).first(1), grid);
  EXPECT_EQ(models[4], own[0]);
  smooth_with(grid, models, together);
  smooth_with(grid, own, alone);
  for (std::size_t t = 0; t < 70; ++t) {
    EXPECT_EQ(together(t, 4), alone(t, 0));
    EXPECT_NE(together(t, 4), all(t, 4));
  }
}

TEST(Evidence, TooShortATakeHasNoModel) {
  const PoseMatrix matrix(3, 2, 1.0);
  EXPECT_TRUE(most_likely_models(matrix, std::vector<double>(2, 1.0), ModelGrid(3, 60)).empty());
}

// A channel at rest with a snap of a few frames.
PoseMatrix sudden_move(std::size_t frames) {
  PoseMatrix matrix(frames, 1);
  for (std::size_t t = 0; t < frames; ++t) {
    const double phase = static_cast<double>(t) - 0.5 * static_cast<double>(frames);
    matrix(t, 0) = 40 / (1 + std::exp(-phase));
  }
  return matrix;
}

double squared_error(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  return sum;
}

TEST(Evidence, FollowingTheMotionBeatsOneStrengthForTheWholeTake) {
  const std::size_t frames = 300;
  const PoseMatrix truth = sudden_move(frames);
  double constant_error = 0, adaptive_error = 0, noise_error = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    PoseMatrix noisy = truth;
    for (double& value : noisy.values) value += random.normal();
    PoseMatrix constant = noisy, adaptive = noisy;
    const std::vector<double> variance{1.0};
    const std::vector<std::size_t> only{0};
    const ModelGrid grid(frames, 120);
    const auto chosen = most_likely_models(noisy, variance, grid);
    ChannelBlock block = gather(noisy, only);
    smooth_with(grid, chosen, block);
    scatter(block, only, constant);
    smooth_adaptively(adaptive, {}, variance, std::vector<SmoothingModel>{grid.models()[chosen[0]]},
                      120);
    constant_error += squared_error(truth, constant);
    adaptive_error += squared_error(truth, adaptive);
    noise_error += squared_error(truth, noisy);
  }
  EXPECT_LT(constant_error, 0.4 * noise_error);
  EXPECT_LT(adaptive_error, 0.8 * constant_error);
}

TEST(Evidence, MissingSamplesHaveNoInfluence) {
  Random random(6);
  const std::size_t frames = 50;
  PoseMatrix first = random_walks(frames, 3, random), second = first;
  std::vector<std::uint8_t> missing(frames * 3);
  for (std::size_t t = 20; t < 26; ++t) {
    missing[t * 3 + 1] = 1;
    second(t, 1) = 1000;
  }
  const std::vector<double> variance(3, 0.25);
  const std::vector<SmoothingModel> models{{1, 5.0}, {2, 20.0}, {3, 100.0}};
  smooth_adaptively(first, missing, variance, models, 60);
  smooth_adaptively(second, missing, variance, models, 60);
  for (std::size_t i = 0; i < first.values.size(); ++i)
    EXPECT_NEAR(first.values[i], second.values[i], 1e-9);
}

}  // namespace
}  // namespace kinemend::signal
