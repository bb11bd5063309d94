// Tests of the linear smoother, against the conditional expectation in dense algebra.
#include "classic/linear_dynamics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "classic/dynamics_support.hpp"
#include "kinemend/error.hpp"

namespace kinemend::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Scene {
  LinearDynamics dynamics;
  PoseMatrix truth, measured;
  std::vector<std::uint8_t> observed;
  std::vector<double> noise_deg;

  MeasurementFacts facts() const { return {observed, noise_deg}; }
};

Scene scene_of(LinearDynamics dynamics, std::size_t frames, double share_missing,
               std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.truth = simulate(dynamics, frames, random);
  scene.dynamics = std::move(dynamics);
  scene.measured = scene.truth;
  const std::size_t channels = scene.truth.channels;
  for (std::size_t c = 0; c < channels; ++c) scene.noise_deg.push_back(0.5 + random.uniform());
  scene.observed.assign(frames * channels, 1);
  for (std::size_t i = 0; i < scene.observed.size(); ++i) {
    scene.measured.values[i] += scene.noise_deg[i % channels] * random.normal();
    if (random.uniform() >= share_missing) continue;
    scene.observed[i] = 0;
    scene.measured.values[i] = 1e6;
  }
  return scene;
}

LinearDynamics first_order(std::uint64_t seed, Index channels = 4) {
  Random random(seed);
  return random_dynamics(random, channels);
}

// Dynamics with two directions in five channels and a state of two poses.
LinearDynamics second_order_in_a_plane(std::uint64_t seed) {
  Random random(seed);
  LinearDynamics dynamics = random_dynamics(random, 4);
  dynamics.order = 2;
  dynamics.mean = random_matrix(random, 5, 1);
  dynamics.basis = orthonormal(random_matrix(random, 5, 5)).leftCols(2);
  dynamics.outside = VectorXd::Constant(5, 0.3);
  dynamics.transition.setZero();
  dynamics.transition.topLeftCorner(2, 2) = 1.7 * MatrixXd::Identity(2, 2);
  dynamics.transition.topRightCorner(2, 2) = -0.8 * MatrixXd::Identity(2, 2);
  dynamics.transition.bottomLeftCorner(2, 2).setIdentity();
  dynamics.drive.setZero();
  dynamics.drive.topLeftCorner(2, 2) = random_covariance(random, 2);
  dynamics.spread = long_run_spread(dynamics.transition, dynamics.drive);
  return dynamics;
}

// The expectation of every channel of frame `at` given the measurements of frames up to `last`,
// by conditioning one Gaussian of all states and all measurements; no recursion.
VectorXd conditioned(const Scene& scene, std::size_t at, std::size_t last) {
  const LinearDynamics& model = scene.dynamics;
  const Index n = model.states(), d = model.channels();
  const auto frames = static_cast<Index>(scene.truth.frames);
  std::vector<MatrixXd> spread = {model.spread};
  for (Index t = 1; t < frames; ++t) {
    spread.push_back(model.transition * spread.back() * model.transition.transpose() + model.drive);
  }
  MatrixXd states(frames * n, frames * n);
  for (Index s = 0; s < frames; ++s) {
    MatrixXd block = spread[static_cast<std::size_t>(s)];
    for (Index t = s; t < frames; ++t) {
      states.block(t * n, s * n, n, n) = block;
      states.block(s * n, t * n, n, n) = block.transpose();
      block = (model.transition * block).eval();
    }
  }
  MatrixXd observe = MatrixXd::Zero(d, n);
  observe.leftCols(model.directions()) =
      model.basis.size() == 0 ? MatrixXd(MatrixXd::Identity(d, d)) : model.basis;
  std::vector<std::pair<std::size_t, std::size_t>> seen;
  for (std::size_t f = 0; f <= last; ++f) {
    for (std::size_t c = 0; c < scene.truth.channels; ++c) {
      if (scene.observed[f * scene.truth.channels + c]) seen.emplace_back(f, c);
    }
  }
  const auto count = static_cast<Index>(seen.size());
  MatrixXd rows = MatrixXd::Zero(count, frames * n);
  VectorXd y(count), noise(count);
  for (Index i = 0; i < count; ++i) {
    const auto [f, c] = seen[static_cast<std::size_t>(i)];
    const auto channel = static_cast<Index>(c);
    rows.block(i, static_cast<Index>(f) * n, 1, n) = observe.row(channel);
    y[i] = scene.measured(f, c) - model.mean[channel];
    noise[i] = scene.noise_deg[c] * scene.noise_deg[c] + model.outside[channel];
  }
  const MatrixXd system = rows * states * rows.transpose() + MatrixXd(noise.asDiagonal());
  const VectorXd expected = states.middleRows(static_cast<Index>(at) * n, n) * rows.transpose() *
                            solve_symmetric(system, y);
  return model.mean + observe * expected;
}

void expect_conditioned(const Scene& scene) {
  PoseMatrix filtered = scene.measured, smoothed = scene.measured;
  filter_with_dynamics(filtered, scene.facts(), scene.dynamics);
  smooth_with_dynamics(smoothed, scene.facts(), scene.dynamics);
  for (std::size_t f = 0; f < scene.truth.frames; ++f) {
    const VectorXd by_past = conditioned(scene, f, f);
    const VectorXd by_all = conditioned(scene, f, scene.truth.frames - 1);
    for (std::size_t c = 0; c < scene.truth.channels; ++c) {
      EXPECT_NEAR(filtered(f, c), by_past[static_cast<Index>(c)], 1e-7) << f << " " << c;
      EXPECT_NEAR(smoothed(f, c), by_all[static_cast<Index>(c)], 1e-7) << f << " " << c;
    }
  }
}

double mean_square(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  }
  return sum / static_cast<double>(a.values.size());
}

TEST(LinearSmoother, GivesTheExpectationGivenTheMeasurements) {
  expect_conditioned(scene_of(first_order(1), 20, 0, 1));
}

TEST(LinearSmoother, GivesTheExpectationWhereSamplesAreMissing) {
  expect_conditioned(scene_of(first_order(2), 20, 0.4, 2));
  expect_conditioned(scene_of(second_order_in_a_plane(3), 20, 0.4, 3));
}

TEST(LinearSmoother, GivesTheExpectationInASubspaceOfTheSecondOrder) {
  expect_conditioned(scene_of(second_order_in_a_plane(4), 20, 0, 4));
}

TEST(LinearSmoother, GivesTheExpectationWhereFramesAndChannelsAreMissingAltogether) {
  Scene scene = scene_of(first_order(5), 16, 0, 5);
  for (std::size_t f = 0; f < 16; ++f) {
    scene.observed[f * 4 + 1] = 0;
    if (f < 3 || (f > 6 && f < 11)) std::fill_n(scene.observed.begin() + 4 * f, 4, 0);
  }
  expect_conditioned(scene);
}

TEST(LinearSmoother, ReturnsTheMeanWhereNothingWasSeen) {
  Scene scene = scene_of(first_order(6), 5, 1, 6);
  smooth_with_dynamics(scene.measured, scene.facts(), scene.dynamics);
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(scene.measured(f, c), scene.dynamics.mean[static_cast<Index>(c)], 1e-9);
    }
  }
}

// Plain textbook recursions without a steady state: Kalman 1960 with a gain, and Rauch, Tung &
// Striebel.
PoseMatrix by_full_recursion(const Scene& scene, bool smooth) {
  const LinearDynamics& model = scene.dynamics;
  const Index n = model.states();
  const MatrixXd noise =
      Eigen::Map<const VectorXd>(scene.noise_deg.data(), n).cwiseAbs2().asDiagonal();
  std::vector<VectorXd> means, predicted;
  std::vector<MatrixXd> covariances, predicted_covariances;
  VectorXd x = VectorXd::Zero(n);
  MatrixXd p = model.spread;
  for (std::size_t f = 0; f < scene.measured.frames; ++f) {
    if (f > 0) {
      x = (model.transition * x).eval();
      p = (model.transition * p * model.transition.transpose() + model.drive).eval();
    }
    predicted.push_back(x);
    predicted_covariances.push_back(p);
    const MatrixXd gain = solve_symmetric(p + noise, p).transpose();
    const Eigen::Map<const VectorXd> y(scene.measured.row(f).data(), n);
    x += (gain * (y - model.mean - x)).eval();
    p -= (gain * p).eval();
    means.push_back(x);
    covariances.push_back(p);
  }
  if (smooth) {
    for (std::size_t f = means.size() - 1; f-- > 0;) {
      const MatrixXd gain =
          solve_symmetric(predicted_covariances[f + 1], model.transition * covariances[f])
              .transpose();
      means[f] += (gain * (means[f + 1] - predicted[f + 1])).eval();
    }
  }
  PoseMatrix result = scene.measured;
  for (std::size_t f = 0; f < means.size(); ++f) {
    Eigen::Map<VectorXd>(result.row(f).data(), n) = means[f] + model.mean;
  }
  return result;
}

TEST(LinearSmoother, EqualsTheFullRecursionAfterItsGainsHaveSettled) {
  for (const bool smooth : {false, true}) {
    const Scene scene = scene_of(first_order(7), 700, 0, 7);
    PoseMatrix found = scene.measured;
    (smooth ? smooth_with_dynamics : filter_with_dynamics)(found, scene.facts(), scene.dynamics);
    const PoseMatrix expected = by_full_recursion(scene, smooth);
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      ASSERT_NEAR(found.values[i], expected.values[i], 1e-6) << i;
    }
  }
}

// The take is long enough that covariances are discarded and recomputed: every frame has another
// pattern of missing samples.
TEST(LinearSmoother, DoesNotDependOnWhatItKeepsBetweenItsPasses) {
  constexpr Index channels = 30;
  constexpr std::size_t frames = 22000;
  Scene scene = scene_of(first_order(8, channels), frames, 0.2, 8);
  PoseMatrix whole = scene.measured;
  smooth_with_dynamics(whole, scene.facts(), scene.dynamics);
  // The end alone gives the same result; frames long before do not matter.
  const std::size_t first = frames - 1000;
  PoseMatrix end(1000, channels);
  const auto skip = static_cast<std::ptrdiff_t>(first * channels);
  std::copy(scene.measured.values.begin() + skip, scene.measured.values.end(), end.values.begin());
  const std::vector<std::uint8_t> seen(scene.observed.begin() + skip, scene.observed.end());
  smooth_with_dynamics(end, {seen, scene.noise_deg}, scene.dynamics);
  for (std::size_t f = 500; f < 1000; ++f) {
    for (std::size_t c = 0; c < channels; ++c) {
      ASSERT_NEAR(end(f, c), whole(first + f, c), 1e-6) << f;
    }
  }
  // The start alone gives the same result.
  scene.observed.resize(1000 * channels);
  PoseMatrix start(1000, channels);
  std::copy_n(scene.measured.values.begin(), start.values.size(), start.values.begin());
  smooth_with_dynamics(start, scene.facts(), scene.dynamics);
  for (std::size_t f = 0; f < 500; ++f) {
    for (std::size_t c = 0; c < channels; ++c) ASSERT_NEAR(start(f, c), whole(f, c), 1e-6) << f;
  }
}

TEST(LinearSmoother, ComesNearerToTheTruthWithMoreToGoBy) {
  const Scene scene = scene_of(first_order(9), 2000, 0, 9);
  PoseMatrix filtered = scene.measured, smoothed = scene.measured;
  filter_with_dynamics(filtered, scene.facts(), scene.dynamics);
  smooth_with_dynamics(smoothed, scene.facts(), scene.dynamics);
  EXPECT_LT(mean_square(filtered, scene.truth), 0.9 * mean_square(scene.measured, scene.truth));
  EXPECT_LT(mean_square(smoothed, scene.truth), 0.95 * mean_square(filtered, scene.truth));
}

TEST(LinearSmoother, LeavesMeasurementsWithoutNoiseAlone) {
  Scene scene = scene_of(first_order(10), 50, 0, 10);
  scene.noise_deg.assign(4, 0.0);
  PoseMatrix found = scene.measured;
  smooth_with_dynamics(found, scene.facts(), scene.dynamics);
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    EXPECT_NEAR(found.values[i], scene.measured.values[i], 1e-4);
  }
}

TEST(LinearSmoother, IsLinearInWhatItMeasures) {
  const Scene scene = scene_of(first_order(11), 60, 0.2, 11);
  PoseMatrix once = scene.measured, twice = scene.measured, none(60, 4);
  for (double& value : twice.values) value *= 2;
  for (PoseMatrix* poses : {&once, &twice, &none})
    smooth_with_dynamics(*poses, scene.facts(), scene.dynamics);
  for (std::size_t i = 0; i < once.values.size(); ++i) {
    EXPECT_NEAR(twice.values[i] - none.values[i], 2 * (once.values[i] - none.values[i]), 1e-6);
  }
}

TEST(LinearSmoother, GivesTheExpectationOfTheShortestTakes) {
  for (const std::size_t frames : {1, 2, 3}) {
    SCOPED_TRACE(frames);
    expect_conditioned(scene_of(first_order(12), frames, 0, 12));
  }
  PoseMatrix nothing(0, 4);
  const std::vector<double> noise_deg(4, 1.0);
  smooth_with_dynamics(nothing, {{}, noise_deg}, first_order(12));
  filter_with_dynamics(nothing, {{}, noise_deg}, first_order(12));
  EXPECT_EQ(nothing.frames, 0u);
  EXPECT_TRUE(nothing.values.empty());
}

TEST(LinearSmoother, RefusesMeasurementsThatDoNotFit) {
  Scene scene = scene_of(first_order(13), 10, 0, 13);
  PoseMatrix narrow(10, 3);
  EXPECT_THROW(smooth_with_dynamics(narrow, scene.facts(), scene.dynamics), Error);
  scene.observed.pop_back();
  EXPECT_THROW(smooth_with_dynamics(scene.measured, scene.facts(), scene.dynamics), Error);
}

}  // namespace
}  // namespace kinemend::test
