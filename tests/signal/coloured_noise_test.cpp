// Tests of the precision and evidence of coloured noise, against dense matrices.
#include "signal/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::signal {
namespace {

constexpr std::size_t frames = 30;

Eigen::MatrixXd covariance(double correlation) {
  Eigen::MatrixXd matrix(frames, frames);
  for (std::size_t i = 0; i < frames; ++i) {
    for (std::size_t j = 0; j < frames; ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::pow(correlation, std::abs(static_cast<double>(i) - static_cast<double>(j)));
  }
  return matrix;
}

Eigen::MatrixXd precision_of(const NoisePrecision& precision, std::size_t channel) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(frames, frames);
  for (std::size_t t = 0; t < frames; ++t) {
    const auto i = static_cast<Eigen::Index>(t);
    matrix(i, i) = precision.weight(t, channel);
    if (t + 1 < frames) matrix(i, i + 1) = matrix(i + 1, i) = precision.coupling(t, channel);
  }
  return matrix;
}

Eigen::MatrixXd differences(std::size_t order) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(frames, frames);
  for (std::size_t k = 0; k < order; ++k) {
    const Eigen::Index rows = matrix.rows() - 1;
    matrix = (matrix.bottomRows(rows) - matrix.topRows(rows)).eval();
  }
  return matrix;
}

TEST(NoisePrecision, IsTheInverseOfTheCovariance) {
  NoisePrecision precision(frames);
  for (const double correlation : {0.0, 0.5, 0.95}) {
    precision.set_channel(2, correlation, {});
    const Eigen::MatrixXd dense = covariance(correlation);
    EXPECT_LT((precision_of(precision, 2) * dense - Eigen::MatrixXd::Identity(frames, frames))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    EXPECT_NEAR(precision.log_determinant[2], -std::log(test::determinant(dense)), 1e-6);
    EXPECT_EQ(precision.observed[2], frames);
  }
}

TEST(NoisePrecision, LeavesMissingSamplesOutAndBeginsAnewBehindThem) {
  std::vector<std::uint8_t> missing(frames);
  missing[0] = missing[10] = missing[11] = 1;
  NoisePrecision precision(frames);
  precision.set_channel(0, 0.8, missing);
  const Eigen::MatrixXd matrix = precision_of(precision, 0);
  for (const Eigen::Index t : {0, 10, 11}) EXPECT_EQ(matrix.row(t).cwiseAbs().sum(), 0);
  const Eigen::MatrixXd part = matrix.block(1, 1, 9, 9);
  const Eigen::MatrixXd dense = covariance(0.8);
  EXPECT_LT(
      (part * dense.block(1, 1, 9, 9) - Eigen::MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff(),
      1e-9);
  EXPECT_EQ(precision.observed[0], frames - 3);
}

// -2 log of the density of the differences, with a flat prior for the polynomial they remove.
TEST(EvidenceOf, IsTheLikelihoodOfTheDifferences) {
  Random random(1);
  ChannelBlock y(frames);
  for (double& value : y.values) value = 3 * random.normal();
  NoisePrecision precision(frames);
  for (std::size_t i = 0; i < block_channels; ++i) precision.set_channel(i, 0.7, {});
  for (std::size_t order = 1; order <= 3; ++order) {
    for (const double strength : {0.1, 10.0, 1e4}) {
      const ColouredEvidence evidence = evidence_of(y, precision, {order, strength});
      const Eigen::MatrixXd d = differences(order);
      for (const double variance : {0.5, 4.0}) {
        const Eigen::MatrixXd marginal =
            variance * (d * covariance(0.7) * d.transpose() +
                        Eigen::MatrixXd::Identity(d.rows(), d.rows()) / strength);
        Eigen::VectorXd values(frames);
        for (std::size_t t = 0; t < frames; ++t) values(static_cast<Eigen::Index>(t)) = y(t, 3);
        const Eigen::VectorXd seen = d * values;
        const double expected = seen.dot(test::solve_symmetric(marginal, seen).col(0)) +
                                std::log(test::determinant(marginal));
        EXPECT_NEAR(evidence.squares[3] / variance + evidence.logarithms[3] +
                        evidence.differences[3] * std::log(variance),
                    expected, 1e-6 * std::abs(expected) + 1e-6);
      }
    }
  }
}

TEST(SmoothAdaptively, WeighsTheRestByThePrecisionOfItsNoise) {
  Random random(2);
  ChannelBlock y(frames);
  for (double& value : y.values) value = random.normal();
  NoisePrecision precision(frames);
  for (std::size_t i = 0; i < block_channels; ++i) precision.set_channel(i, 0.8, {});
  const std::vector<double> variance(block_channels, 1);
  for (std::size_t order = 1; order <= 3; ++order) {
    const std::vector<SmoothingModel> models(block_channels, {order, 50});
    AdaptiveSettings settings;
    settings.iterations = 0;
    const ChannelBlock x = smooth_adaptively(y, precision.weight, variance, models, 120, settings,
                                             &precision.coupling);
    const Eigen::MatrixXd d = differences(order), k = test::inverse(covariance(0.8));
    Eigen::VectorXd values(frames);
    for (std::size_t t = 0; t < frames; ++t) values(static_cast<Eigen::Index>(t)) = y(t, 5);
    const Eigen::VectorXd expected = test::solve_symmetric(k + 50 * d.transpose() * d, k * values);
    for (std::size_t t = 0; t < frames; ++t)
      EXPECT_NEAR(x(t, 5), expected(static_cast<Eigen::Index>(t)), 1e-9);
  }
}

}  // namespace
}  // namespace kinemend::signal
