// Tests of learned linear dynamics, on motion made by known matrices.
#include "learned/papers/linear_dynamics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "kinemend/error.hpp"
#include "kinemend/experimental/train.hpp"
#include "learned/papers/dynamics_support.hpp"

namespace kinemend::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest(const MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

double growth(const MatrixXd& matrix) { return spectral_radius(matrix); }

LinearDynamics fitted(const PoseMatrix& poses, LinearDynamicsSettings settings = {}) {
  LinearDynamicsFit fit(poses.channels, settings.order);
  fit.add(poses);
  return fit.finish(settings);
}

TEST(LinearDynamics, RecoversTheMatricesThatMadeTheMotion) {
  Random random(1);
  const LinearDynamics truth = random_dynamics(random, 6);
  const LinearDynamics found = fitted(simulate(truth, 200000, random));
  EXPECT_LT(largest(found.transition - truth.transition), 0.02);
  EXPECT_LT(largest(found.drive - truth.drive), 0.05);
  EXPECT_LT(largest(found.mean - truth.mean), 0.3);
  EXPECT_LT(largest(found.spread - truth.spread), 0.1 * largest(truth.spread));
}

// x_{t+1} = A_1 x_t + A_2 x_{t-1} + w.
TEST(LinearDynamics, RecoversMotionOfTheSecondOrder) {
  Random random(2);
  LinearDynamics truth = random_dynamics(random, 8);
  MatrixXd coefficients(4, 8);
  coefficients << 1.7 * MatrixXd::Identity(4, 4) + 0.02 * random_matrix(random, 4, 4),
      -0.75 * MatrixXd::Identity(4, 4);
  truth.order = 2;
  truth.mean = truth.mean.head(4).eval();
  truth.transition.setZero();
  truth.transition.topRows(4) = coefficients;
  truth.transition.bottomLeftCorner(4, 4).setIdentity();
  const MatrixXd drive = random_covariance(random, 4);
  truth.drive.setZero();
  truth.drive.topLeftCorner(4, 4) = drive;
  ASSERT_LT(growth(truth.transition), 1);
  truth.spread = long_run_spread(truth.transition, truth.drive);

  const LinearDynamics found = fitted(simulate(truth, 200000, random), {.order = 2});
  EXPECT_LT(largest(found.transition - truth.transition), 0.02);
  EXPECT_LT(largest(found.drive - truth.drive), 0.05);
}

// Least squares over all transitions at once, by QR.
TEST(LinearDynamics, IsTheLeastSquaresFitOfAllTransitions) {
  Random random(3);
  const PoseMatrix poses = simulate(random_dynamics(random, 4), 300, random);
  const LinearDynamics found = fitted(poses, {.ridge = 0});
  const Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> x(poses.values.data(), 300,
                                                                           4);
  const Eigen::RowVectorXd mean = x.bottomRows(299).colwise().mean();
  const MatrixXd before = x.topRows(299).rowwise() - mean,
                 after = x.bottomRows(299).rowwise() - mean;
  const MatrixXd a = least_squares(before, after).transpose();
  const MatrixXd residual = after - before * a.transpose();
  EXPECT_LT(largest(found.mean.transpose() - mean), 1e-9);
  EXPECT_LT(largest(found.transition - a), 1e-5);
  EXPECT_LT(largest(found.drive - residual.transpose() * residual / 299), 1e-5);
}

TEST(LinearDynamics, TakesSequencesInAnyOrderAndCutsNoTransitionAcrossThem) {
  Random random(4);
  const LinearDynamics truth = random_dynamics(random, 3);
  const PoseMatrix a = simulate(truth, 400, random), b = simulate(truth, 300, random);
  LinearDynamicsFit ab(3, 1), ba(3, 1);
  ab.add(a), ab.add(b);
  ba.add(b), ba.add(a);
  EXPECT_DOUBLE_EQ(ab.transitions(), 399 + 299);
  EXPECT_LT(largest(ab.finish({}).transition - ba.finish({}).transition), 1e-9);
  EXPECT_LT(largest(ab.finish({}).drive - ba.finish({}).drive), 1e-9);
}

TEST(LinearDynamics, CountsAWeightedSequenceAsOftenAsItsWeight) {
  Random random(5);
  const LinearDynamics truth = random_dynamics(random, 3);
  const PoseMatrix a = simulate(truth, 100, random), b = simulate(truth, 100, random);
  LinearDynamicsFit weighted(3, 1), repeated(3, 1);
  weighted.add(a), weighted.add(b, 3);
  repeated.add(a);
  for (int i = 0; i < 3; ++i) repeated.add(b);
  EXPECT_LT(largest(weighted.finish({}).transition - repeated.finish({}).transition), 1e-9);
  EXPECT_LT(largest(weighted.finish({}).mean - repeated.finish({}).mean), 1e-9);
}

TEST(LinearDynamics, LosesNoDigitsFarFromZero) {
  Random random(6);
  PoseMatrix near = simulate(random_dynamics(random, 3), 500, random), far = near;
  for (double& value : far.values) value += 1e7;
  EXPECT_LT(largest(fitted(near).transition - fitted(far).transition), 1e-5);
}

TEST(LinearDynamics, NeverLetsMotionGrow) {
  PoseMatrix poses(50, 2);
  for (std::size_t f = 0; f < 50; ++f) {
    poses(f, 0) = std::pow(1.2, static_cast<double>(f));
    poses(f, 1) = -poses(f, 0) + static_cast<double>(f);
  }
  const LinearDynamics found = fitted(poses, {.ridge = 0});
  EXPECT_LT(growth(found.transition), 1);
  EXPECT_GT(growth(found.transition), 0.99);
}

TEST(LinearDynamics, KeepsTheDirectionsThatMoveMost) {
  Random random(7);
  const LinearDynamics within = random_dynamics(random, 2);
  const PoseMatrix inner = simulate(within, 2000, random);
  const MatrixXd plane = orthonormal(random_matrix(random, 5, 5)).leftCols(2);
  PoseMatrix poses(2000, 5);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    const Eigen::Map<const VectorXd> z(inner.row(f).data(), 2);
    Eigen::Map<VectorXd>(poses.row(f).data(), 5) = plane * z + 0.1 * random_matrix(random, 5, 1);
  }
  const LinearDynamics found = fitted(poses, {.directions = 2});
  ASSERT_EQ(found.basis.cols(), 2);
  EXPECT_LT(largest(found.basis.transpose() * found.basis - MatrixXd::Identity(2, 2)), 1e-12);
  EXPECT_LT(largest(plane - found.basis * found.basis.transpose() * plane), 0.01);
  // What is left out is the noise outside of the plane.
  EXPECT_NEAR(found.outside.sum(), 3 * 0.01, 0.003);
}

TEST(LinearDynamics, MakesManyShortStepsOfOneLongOne) {
  Random random(8);
  const LinearDynamics slow = random_dynamics(random, 6);
  for (const int steps : {2, 3, 4}) {
    const LinearDynamics fast = at_rate(slow, slow.rate_hz * steps);
    EXPECT_DOUBLE_EQ(fast.rate_hz, slow.rate_hz * steps);
    MatrixXd transition = MatrixXd::Identity(6, 6), drive = MatrixXd::Zero(6, 6);
    for (int i = 0; i < steps; ++i) {
      drive = (fast.transition * drive * fast.transition.transpose() + fast.drive).eval();
      transition = (fast.transition * transition).eval();
    }
    EXPECT_LT(largest(transition - slow.transition), 1e-8) << steps;
    EXPECT_LT(largest(drive - slow.drive), 1e-6) << steps;
  }
}

TEST(LinearDynamics, MakesOneLongStepOfManyShortOnes) {
  Random random(9);
  const LinearDynamics fast = random_dynamics(random, 4);
  const LinearDynamics slow = at_rate(fast, fast.rate_hz / 3);
  const MatrixXd& a = fast.transition;
  EXPECT_LT(largest(slow.transition - a * a * a), 1e-9);
  const MatrixXd once = fast.drive + a * fast.drive * a.transpose();
  EXPECT_LT(largest(slow.drive - (fast.drive + a * once * a.transpose())), 1e-8);
}

TEST(LinearDynamics, IsItselfAtItsOwnRate) {
  Random random(10);
  const LinearDynamics dynamics = random_dynamics(random, 3);
  const LinearDynamics same = at_rate(dynamics, dynamics.rate_hz);
  EXPECT_EQ(same.transition, dynamics.transition);
  EXPECT_EQ(same.drive, dynamics.drive);
}

// A direction that changes its sign with every frame has no half step.
TEST(LinearDynamics, ForgetsWhatHasNoRoot) {
  Random random(11);
  LinearDynamics dynamics = random_dynamics(random, 3);
  dynamics.transition = VectorXd{{0.9, -0.5, 0.0}}.asDiagonal();
  dynamics.drive = MatrixXd::Identity(3, 3);
  const LinearDynamics fast = at_rate(dynamics, 2 * dynamics.rate_hz);
  ASSERT_TRUE(fast.transition.allFinite());
  EXPECT_NEAR(fast.transition(0, 0), std::sqrt(0.9), 1e-9);
  EXPECT_NEAR(fast.transition(1, 1), 0, 2e-3);
  EXPECT_NEAR(fast.transition(2, 2), 0, 2e-3);
  EXPECT_GE(symmetric_eigen(fast.drive).values.minCoeff(), -1e-9);
}

TEST(LinearDynamics, KeepsTheSpreadOfMotionOfTheSecondOrderAtAnyRate) {
  Random random(12);
  PoseMatrix poses(5000, 3);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    const double t = static_cast<double>(f) / 30;
    for (std::size_t c = 0; c < 3; ++c) {
      poses(f, c) = 20 * std::sin((5 + static_cast<double>(c)) * t) + 0.2 * random.normal();
    }
  }
  const LinearDynamics slow = fitted(poses, {.order = 2});
  const MatrixXd spread = long_run_spread(slow.transition, slow.drive);
  const LinearDynamics fast = at_rate(slow, 120);
  ASSERT_LT(growth(fast.transition), 1);
  const MatrixXd of_fast = long_run_spread(fast.transition, fast.drive);
  EXPECT_LT(largest(of_fast - spread), 0.05 * largest(spread));
}

TEST(LinearDynamics, ComesBackFromAModelFile) {
  Random random(13);
  for (const std::size_t order : {1, 2}) {
    const PoseMatrix poses = simulate(random_dynamics(random, 6), 500, random);
    const LinearDynamics dynamics = fitted(poses, {24, order, 1e-4, 4});
    Model model;
    model.layout.names = {"a"};
    model.layout.with_place = true;
    store_dynamics(dynamics, model);
    const LinearDynamics back = dynamics_of(model);
    EXPECT_DOUBLE_EQ(back.rate_hz, 24);
    EXPECT_EQ(back.order, order);
    EXPECT_LT(largest(back.transition - dynamics.transition), 1e-5);
    EXPECT_LT(largest(back.drive - dynamics.drive), 1e-4);
    EXPECT_LT(largest(back.basis - dynamics.basis), 1e-6);
    EXPECT_LT(largest(back.mean - dynamics.mean), 1e-4);
  }
}

TEST(LinearDynamics, RefusesAModelFileThatDoesNotFit) {
  Random random(14);
  Model model;
  model.layout.names = {"a"};
  store_dynamics(fitted(simulate(random_dynamics(random, 6), 100, random)), model);
  EXPECT_NO_THROW(dynamics_of(model));
  Model other = model;
  other.layout.names = {"a", "b"};
  EXPECT_THROW(dynamics_of(other), Error);
  other = model;
  other.numbers["order"] = 3;
  EXPECT_THROW(dynamics_of(other), Error);
  other = model;
  other.tensors.erase("drive");
  EXPECT_THROW(dynamics_of(other), Error);
  other = model;
  other.tensors["basis"] = {TensorType::f32, {6, 7}, std::vector<double>(42)};
  EXPECT_THROW(dynamics_of(other), Error);
}

TEST(LinearDynamics, SaysThatThereWasNoMotion) {
  LinearDynamicsFit fit(3, 1);
  fit.add(PoseMatrix(1, 3));
  EXPECT_THROW(fit.finish({}), Error);
  EXPECT_THROW(fit.add(PoseMatrix(5, 2)), Error);
  EXPECT_THROW(LinearDynamicsFit(3, 3), Error);
}

}  // namespace
}  // namespace kinemend::test
