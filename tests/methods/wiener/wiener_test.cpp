// Tests of the method `wiener`: posterior, mixture, filter, guard, outliers and prior.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>

#include "classic/dynamics_support.hpp"
#include "dense_algebra.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/signal.hpp"
#include "lab/training/mixture_fit.hpp"
#include "lab/training/wiener_fit.hpp"
#include "methods/prior/window_bases.hpp"
#include "methods/wiener/wiener_filter.hpp"
#include "methods/wiener/wiener_steps.hpp"

namespace kinemend::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index channels = 3, coefficients = 4, rank = 3, window = 8;

MatrixXd wide_covariance(Random& random, Index size) {
  const MatrixXd root = random_matrix(random, size, size);
  return root * root.transpose() + 0.3 * MatrixXd::Identity(size, size);
}

WienerPrior random_prior(Random& random, std::size_t components) {
  WienerPrior prior;
  prior.window_s = 0.08;  // 8 frames at 100 Hz
  prior.mean = random_matrix(random, channels * coefficients, 1);
  prior.basis = random_matrix(random, channels * coefficients, rank);
  prior.rest = random_matrix(random, channels, window).cwiseAbs2().array() + 0.1;
  for (std::size_t c = 0; c < components; ++c) {
    prior.components.push_back({1 / static_cast<double>(components), random_matrix(random, rank, 1),
                                wide_covariance(random, rank)});
  }
  return prior;
}

PoseMatrix random_poses(Random& random, Index frames) {
  PoseMatrix poses(static_cast<std::size_t>(frames), channels);
  for (double& value : poses.values) value = random.normal();
  return poses;
}

// The observed samples as a dense linear Gaussian model: y = H x + noise.
struct Dense {
  MatrixXd h;
  VectorXd y, noise;
};
Dense dense_model(const PoseMatrix& poses, const std::vector<std::uint8_t>& observed,
                  const std::vector<double>& noise) {
  const MatrixXd cosines = window_cosines(window, coefficients);
  std::vector<VectorXd> rows;
  std::vector<double> values, variances;
  for (Index f = 0; f < window; ++f) {
    for (Index d = 0; d < channels; ++d) {
      const auto sample = static_cast<std::size_t>(f * channels + d);
      if (observed[sample] == 0) continue;
      VectorXd row = VectorXd::Zero(channels * coefficients);
      row.segment(d * coefficients, coefficients) = cosines.row(f).transpose();
      rows.push_back(row);
      values.push_back(poses.values[sample]);
      variances.push_back(std::pow(noise[static_cast<std::size_t>(d)], 2));
    }
  }
  const auto count = static_cast<Index>(rows.size());
  Dense dense{MatrixXd(count, channels * coefficients), VectorXd(count), VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    dense.h.row(i) = rows[n].transpose();
    dense.y(i) = values[n];
    dense.noise(i) = variances[n];
  }
  return dense;
}

// Half of the samples of channel 1 are missing, and all of channel 2.
std::vector<std::uint8_t> with_gaps() {
  std::vector<std::uint8_t> observed(window * channels, 1);
  for (std::size_t f = 0; f < window; ++f) {
    if (f % 2 == 1) observed[f * channels + 1] = 0;
    observed[f * channels + 2] = 0;
  }
  return observed;
}

struct Explained {
  MixturePosterior posterior;
  Dense dense;
  WienerPrior prior;
};
Explained explained(std::uint64_t seed, std::size_t components,
                    const std::vector<std::uint8_t>& observed) {
  Random random(seed);
  Explained result;
  result.prior = random_prior(random, components);
  const PoseMatrix poses = random_poses(random, window);
  const std::vector<double> noise = {0.5, 0.8, 1.1};
  const WienerWindows windows(result.prior, window, window, observed, noise);
  const VectorXd h = result.prior.basis.transpose() *
                     windows.information(poses, 0, windows.coefficients(poses, 0));
  result.posterior =
      mixture_posterior(result.prior.components, windows.precision(windows.groups().front()), h);
  result.dense = dense_model(poses, observed, noise);
  return result;
}

void expect_conditioning(const std::vector<std::uint8_t>& observed) {
  const Explained found = explained(3, 1, observed);
  const WienerPrior::Component& component = found.prior.components.front();
  const VectorXd rest = Eigen::Map<const VectorXd>(
      MatrixXd(found.prior.rest.leftCols(coefficients).transpose()).eval().data(),
      channels * coefficients);
  const MatrixXd& h = found.dense.h;
  MatrixXd covariance = h * rest.asDiagonal() * h.transpose();
  covariance += found.dense.noise.asDiagonal();
  const MatrixXd from_z = h * found.prior.basis;
  covariance += from_z * component.covariance * from_z.transpose();
  const VectorXd expected =
      component.mean + component.covariance * from_z.transpose() *
                           test::solve_symmetric(covariance, found.dense.y - h * found.prior.mean -
                                                                 from_z * component.mean);
  EXPECT_LT((found.posterior.mean().col(0) - expected).norm(), 1e-9);
}

TEST(WienerPosterior, IsGaussianConditioning) {
  expect_conditioning(std::vector<std::uint8_t>(window * channels, 1));
}

TEST(WienerPosterior, LeavesOutMissingSamples) { expect_conditioning(with_gaps()); }

TEST(WienerPosterior, WeighsComponentsByTheirEvidence) {
  for (const auto& observed : {std::vector<std::uint8_t>(window * channels, 1), with_gaps()}) {
    const Explained found = explained(5, 3, observed);
    const MatrixXd from_z = found.dense.h * found.prior.basis;
    const VectorXd rest = Eigen::Map<const VectorXd>(
        MatrixXd(found.prior.rest.leftCols(coefficients).transpose()).eval().data(),
        channels * coefficients);
    VectorXd evidence(3);
    for (Index c = 0; c < 3; ++c) {
      const auto& component = found.prior.components[static_cast<std::size_t>(c)];
      MatrixXd covariance = found.dense.h * rest.asDiagonal() * found.dense.h.transpose() +
                            from_z * component.covariance * from_z.transpose();
      covariance += found.dense.noise.asDiagonal();
      const VectorXd gap =
          found.dense.y - found.dense.h * found.prior.mean - from_z * component.mean;
      evidence(c) = -0.5 * (std::log(test::determinant(covariance)) +
                            gap.dot(test::solve_symmetric(covariance, gap).col(0)));
    }
    VectorXd expected = (evidence.array() - evidence.maxCoeff()).exp();
    expected /= expected.sum();
    EXPECT_LT((found.posterior.shares.col(0) - expected).norm(), 1e-9);
  }
}

TEST(MixtureFit, FindsTwoClouds) {
  Random random(1);
  MatrixXd points(2, 400);
  for (Index w = 0; w < 400; ++w) {
    points(0, w) = (w % 4 == 0 ? 20 : -20) + random.normal();
    points(1, w) = 2 * random.normal();
  }
  const auto components = fit_mixture(points, {2, 10, 1, 1});
  ASSERT_EQ(components.size(), 2U);
  const auto& right = components[components[0].mean(0) > 0 ? 0 : 1];
  EXPECT_NEAR(right.weight, 0.25, 1e-6);
  EXPECT_NEAR(right.mean(0), 20, 0.5);
  EXPECT_NEAR(right.covariance(1, 1), 4, 1.5);
}

WienerResult filtered(const WienerPrior& prior, const PoseMatrix& poses, double noise,
                      const WienerSettings& settings) {
  const std::vector<double> deviations(channels, noise);
  return wiener_filter(prior, {poses, poses, {}, {}, deviations, 100}, settings);
}

TEST(WienerFilter, LeavesATakeWithoutNoise) {
  Random random(4);
  const WienerPrior prior = random_prior(random, 2);
  const PoseMatrix poses = random_poses(random, 45);
  const PoseMatrix result = filtered(prior, poses, 1e-4, {}).poses;
  for (std::size_t i = 0; i < poses.values.size(); ++i)
    EXPECT_NEAR(result.values[i], poses.values[i], 1e-3);
}

TEST(WienerFilter, IsThePriorMeanWhereNoiseIsAll) {
  Random random(4);
  const WienerPrior prior = random_prior(random, 1);
  WienerSettings settings;
  settings.rounds = 0;
  const PoseMatrix result = filtered(prior, random_poses(random, window), 1e4, settings).poses;
  const VectorXd x = prior.mean + prior.basis * prior.components[0].mean;
  const MatrixXd expected = window_cosines(window, coefficients) *
                            Eigen::Map<const MatrixXd>(x.data(), coefficients, channels);
  for (Index f = 0; f < window; ++f) {
    for (Index d = 0; d < channels; ++d) {
      EXPECT_NEAR(result(static_cast<std::size_t>(f), static_cast<std::size_t>(d)), expected(f, d),
                  1e-3);
    }
  }
}

TEST(WienerFilter, TakesTakesOfAnyLength) {
  Random random(4);
  const WienerPrior prior = random_prior(random, 2);
  for (const Index frames : {0, 1, 2, 7, 8, 9, 30}) {
    const PoseMatrix result = filtered(prior, random_poses(random, frames), 0.5, {}).poses;
    EXPECT_EQ(result.frames, static_cast<std::size_t>(frames));
    for (const double value : result.values) EXPECT_TRUE(std::isfinite(value));
  }
}

// Three channels of one oscillation with changing phase and size.
PoseMatrix oscillation(std::uint64_t seed, std::size_t frames) {
  Random random(seed);
  const double phase = random.uniform(0, 6), size = random.uniform(10, 20);
  PoseMatrix poses(frames, channels);
  for (std::size_t f = 0; f < frames; ++f) {
    const double s =
        size * std::sin(phase + 2 * std::numbers::pi * 1.5 * static_cast<double>(f) / 100);
    poses(f, 0) = s;
    poses(f, 1) = -0.5 * s + 3;
    poses(f, 2) = 2 * s;
  }
  return poses;
}

WienerPrior learned() {
  WienerFitSettings settings;
  settings.rate_hz = 100;
  settings.window_s = 0.4;
  settings.coefficients = 12;
  settings.rank = 8;
  settings.components = 2;
  WienerFit fit(channels, settings);
  for (std::uint64_t seed = 0; seed < 30; ++seed) fit.add_moments(oscillation(seed, 200));
  fit.find_basis();
  for (std::uint64_t seed = 0; seed < 30; ++seed) fit.add_windows(oscillation(seed, 200));
  return fit.finish();
}

double error(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(a.values[i] - b.values[i], 2);
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

PoseMatrix with_noise(PoseMatrix poses, double deviation) {
  Random random(11);
  for (double& value : poses.values) value += deviation * random.normal();
  return poses;
}

TEST(WienerFilter, RemovesMostOfTheNoiseOfMotionLikeThatLearned) {
  const PoseMatrix truth = oscillation(77, 300), noisy = with_noise(truth, 4);
  EXPECT_LT(error(filtered(learned(), noisy, 4, {}).poses, truth), 0.25 * error(noisy, truth));
}

TEST(WienerFilter, FillsAChannelFromThoseThatMoveWithIt) {
  const PoseMatrix truth = oscillation(77, 300);
  PoseMatrix noisy = with_noise(truth, 0.5);
  std::vector<std::uint8_t> observed(noisy.values.size(), 1);
  for (std::size_t f = 0; f < 300; ++f) {
    observed[f * channels + 2] = 0;
    noisy(f, 2) = 1000;
  }
  const std::vector<double> deviations(channels, 0.5);
  const PoseMatrix zeros(300, channels);
  const WienerResult result =
      wiener_filter(learned(), {noisy, zeros, observed, {}, deviations, 100});
  for (std::size_t f = 0; f < 300; ++f) EXPECT_NEAR(result.poses(f, 2), truth(f, 2), 3);
}

TEST(WienerFilter, TakesSuspectsOut) {
  const PoseMatrix truth = oscillation(77, 300), clean = with_noise(truth, 1);
  PoseMatrix noisy = clean;
  std::vector<std::uint8_t> suspect(noisy.values.size(), 0);
  for (const std::size_t f : {50U, 51U, 140U, 290U}) {
    noisy(f, 0) += 60;
    suspect[f * channels] = 1;
  }
  const std::vector<double> deviations(channels, 1);
  const WienerResult result =
      wiener_filter(learned(), {noisy, truth, {}, suspect, deviations, 100});
  EXPECT_LT(error(result.poses, truth),
            1.2 * error(filtered(learned(), clean, 1, {}).poses, truth));
  EXPECT_EQ(result.rejected[140 * channels], 1);
  EXPECT_EQ(result.rejected[100 * channels], 0);
}

TEST(WienerFilter, KnowsMotionAtOtherRates) {
  // Every second frame of a take is the same motion at half the rate.
  const PoseMatrix truth = oscillation(77, 300);
  PoseMatrix half(150, channels);
  for (std::size_t f = 0; f < 150; ++f) {
    for (std::size_t d = 0; d < channels; ++d) half(f, d) = truth(2 * f, d);
  }
  const PoseMatrix noisy = with_noise(half, 4);
  const std::vector<double> deviations(channels, 4);
  const WienerResult result = wiener_filter(learned(), {noisy, noisy, {}, {}, deviations, 50});
  EXPECT_LT(error(result.poses, half), 0.4 * error(noisy, half));
}

TEST(WienerGuard, LeavesMotionUnlikeAllThatWasLearnedToAGaussian) {
  // Channels that move independently, far from the training data.
  PoseMatrix truth(400, channels);
  for (std::size_t f = 0; f < 400; ++f) {
    const double t = static_cast<double>(f) / 100;
    truth(f, 0) = 150 + 30 * std::sin(2 * t);
    truth(f, 1) = -170 + 40 * std::cos(1.5 * t);
    truth(f, 2) = 90 * std::sin(1.1 * t);
  }
  const PoseMatrix noisy = with_noise(truth, 4);
  const std::vector<double> deviations(channels, 4);
  const WienerTake take{noisy, noisy, {}, {}, deviations, 100};
  const double guarded = error(guarded_wiener_filter(learned(), take).poses, truth);
  double best = 1e9;
  for (const double width : {4.0, 6.0, 8.0, 11.0, 15.0, 20.0}) {
    PoseMatrix smooth = noisy;
    gaussian_filter(smooth, width);
    best = std::min(best, error(smooth, truth));
  }
  EXPECT_LT(guarded, 1.1 * best);
}

TEST(WienerGuard, TakesNothingFromTheSmootherWhereNothingWasMeasured) {
  const PoseMatrix truth = oscillation(77, 300);
  const PoseMatrix noisy = with_noise(truth, 0.5), zeros(300, channels);
  std::vector<std::uint8_t> observed(noisy.values.size(), 1);
  for (std::size_t f = 0; f < 300; ++f) observed[f * channels + 2] = 0;
  const std::vector<double> deviations(channels, 0.5);
  const WienerTake take{noisy, zeros, observed, {}, deviations, 100};
  const WienerResult result = guarded_wiener_filter(learned(), take);
  for (std::size_t f = 0; f < 300; ++f) EXPECT_NEAR(result.poses(f, 2), truth(f, 2), 3);
}

TEST(WienerOutliers, AreFoundWhereTheyAreDense) {
  const PoseMatrix truth = oscillation(77, 300);
  PoseMatrix noisy = with_noise(truth, 0.5);
  Random random(3);
  std::vector<std::uint8_t> hit(noisy.values.size(), 0);
  for (std::size_t f = 0; f < 300; ++f) {
    if (!random.chance(0.15)) continue;
    for (std::size_t d = 0; d < channels; ++d) {
      noisy(f, d) += random.uniform(20, 60) * (random.chance(0.5) ? 1 : -1);
      hit[f * channels + d] = 1;
    }
  }
  const std::vector<double> deviations(channels, 0.5);
  const WienerOutliers found = dense_outliers(learned(), {noisy, noisy, {}, {}, deviations, 100});
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < hit.size(); ++i) wrong += found.suspect[i] != hit[i];
  EXPECT_LT(wrong, hit.size() / 30);
  const WienerTake take{noisy, found.guess, {}, found.suspect, deviations, 100};
  EXPECT_LT(error(wiener_filter(learned(), take).poses, truth), 1.5);
}

TEST(WienerPrior, TurnsItsChannels) {
  Random random(6);
  const WienerPrior prior = random_prior(random, 1);
  const Eigen::Matrix3d turn = test::orthonormal(random_matrix(random, 3, 3));
  const WienerPrior turned = with_turned_channels(prior, std::vector{turn});
  const auto windows_of = [](const VectorXd& x) {
    return MatrixXd(Eigen::Map<const MatrixXd>(x.data(), coefficients, channels));
  };
  EXPECT_LT((windows_of(turned.mean) - windows_of(prior.mean) * turn.transpose()).norm(), 1e-12);
  for (Index r = 0; r < rank; ++r) {
    EXPECT_LT((windows_of(turned.basis.col(r)) - windows_of(prior.basis.col(r)) * turn.transpose())
                  .norm(),
              1e-12);
  }
  for (Index k = 0; k < window; ++k) {
    const Eigen::Matrix3d covariance = turn * prior.rest.col(k).asDiagonal() * turn.transpose();
    EXPECT_LT((turned.rest.col(k) - covariance.diagonal()).norm(), 1e-12);
  }
}

TEST(FourthDifferences, OfAQuarticAre24WhereFiveSamplesInARowAreUsed) {
  PoseMatrix poses(12, 2);
  for (std::size_t f = 0; f < 12; ++f) poses(f, 1) = std::pow(static_cast<double>(f), 4);
  std::size_t count = 0;
  for_each_fourth_difference(
      poses, 1, [](std::size_t sample) { return sample != 2 * 5 + 1; },
      [&](double difference) {
        EXPECT_EQ(difference, 24);
        ++count;
      });
  EXPECT_EQ(count, 3u);  // at frames 4, 10 and 11
}

TEST(WienerPrior, ComesBackFromAModel) {
  Random random(9);
  const WienerPrior prior = random_prior(random, 2);
  Model model;
  model.layout.names = {"Hips"};
  model.layout.with_place = false;
  store_wiener_prior(prior, model);
  const WienerPrior back = wiener_prior_of(model);
  EXPECT_EQ(back.window_s, prior.window_s);
  EXPECT_LT((back.mean - prior.mean).norm(), 1e-12);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_LT((back.components[c].covariance - prior.components[c].covariance).norm(), 1e-9);
  }
  model.tensors["factors"].shape[1] -= 1;
  EXPECT_THROW(wiener_prior_of(model), Error);
}

}  // namespace
}  // namespace kinemend::test
