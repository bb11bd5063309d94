// Tests of noise and bias of rotations, by the deviation and the correlation of the errors.
#include <gtest/gtest.h>

#include <numeric>

#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::chain_clip;
using test::damaged;
using test::degree;
using test::deviation_of;
using test::errors_of;
using test::mean_of;
using test::moving_chain;
using test::same_bits;

constexpr std::size_t many =
    20000;  // frames: a standard deviation is known to 0.5 %, a mean to 0.7 % of it

struct Components {
  std::vector<double> x, y, z;
};

Components components_of(const std::vector<Vec3>& vectors) {
  Components c;
  for (const Vec3 v : vectors) {
    c.x.push_back(v.x);
    c.y.push_back(v.y);
    c.z.push_back(v.z);
  }
  return c;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b,
                   std::size_t lag = 0) {
  double sum = 0;
  for (std::size_t i = lag; i < a.size(); ++i) sum += a[i] * b[i - lag];
  return sum / static_cast<double>(a.size() - lag) / (deviation_of(a) * deviation_of(b));
}

TEST(Gaussian, HasTheDeviationAskedForAboutEachAxis) {
  const Take clean = moving_chain(2, many);
  const Take noisy = damaged(clean, "gaussian", {{"std_deg", 1.5}}).clip;
  for (std::size_t j = 0; j < 2; ++j) {
    const auto c = components_of(errors_of(clean, noisy, j));
    for (const auto* axis : {&c.x, &c.y, &c.z}) {
      EXPECT_NEAR(deviation_of(*axis), 1.5 * degree, 0.03 * degree);
      EXPECT_NEAR(mean_of(*axis), 0, 0.04 * degree);
      EXPECT_NEAR(correlation(*axis, *axis, 1), 0, 0.03) << "white";
    }
    EXPECT_NEAR(correlation(c.x, c.y), 0, 0.03);
  }
  const auto first = components_of(errors_of(clean, noisy, 0)),
             second = components_of(errors_of(clean, noisy, 1));
  EXPECT_NEAR(correlation(first.x, second.x), 0, 0.03) << "joints are independent";
}

TEST(Gaussian, ReportsTheRealisedAmount) {
  const auto [noisy, report] = damaged(moving_chain(3, 5000), "gaussian", {{"std_deg", 2.0}});
  EXPECT_NEAR(report.rms_deg, 2 * std::sqrt(3.0), 0.03);
  EXPECT_EQ(report.samples_damaged, 15000u);
}

TEST(Gaussian, OfZeroDegreesChangesNothing) {
  const Take clean = moving_chain(3, 50);
  const auto [noisy, report] = damaged(clean, "gaussian", {{"std_deg", 0.0}});
  EXPECT_EQ(report.samples_damaged, 0u);
  EXPECT_EQ(noisy.rotations, clean.rotations);
}

TEST(Uniform, StaysInItsHalfWidthWithTheDeviationOfAUniform) {
  const Take clean = moving_chain(1, many);
  const Take noisy = damaged(clean, "uniform", {{"half_width_deg", 3.0}}).clip;
  const auto c = components_of(errors_of(clean, noisy, 0));
  for (const auto* axis : {&c.x, &c.y, &c.z}) {
    EXPECT_NEAR(deviation_of(*axis), 3 / std::sqrt(3.0) * degree, 0.03 * degree);
    const auto [low, high] = std::minmax_element(axis->begin(), axis->end());
    EXPECT_GE(*low, -3.0001 * degree);
    EXPECT_LE(*high, 3.0001 * degree);
    EXPECT_GT(*high, 2.9 * degree);
  }
}

TEST(GaussianLog, IsNoiseOnHalfTheRotationVectorOfThePose) {
  const Take clean = moving_chain(2, many);
  const Take noisy = damaged(clean, "gaussian-log", {{"sigma", 0.02}}).clip;
  std::vector<Vec3> differences;
  for (std::size_t f = 0; f < many; ++f)
    differences.push_back(0.5 * (log(noisy.rotation(f, 1)) - log(clean.rotation(f, 1))));
  const auto c = components_of(differences);
  for (const auto* axis : {&c.x, &c.y, &c.z}) EXPECT_NEAR(deviation_of(*axis), 0.02, 0.0004);
}

TEST(GaussianLog, AboutTheSampleTurnsByTwiceSigma) {
  const Take clean = moving_chain(2, many);
  const Take noisy =
      damaged(clean, "gaussian-log", {{"sigma", 0.02}, {"about", std::string("sample")}}).clip;
  const auto c = components_of(errors_of(clean, noisy, 1));
  for (const auto* axis : {&c.x, &c.y, &c.z}) EXPECT_NEAR(deviation_of(*axis), 0.04, 0.0008);
}

// A joint whose z channel makes several whole turns while x swings and y rests.
Take turning_clip(std::size_t frames) {
  Take clip = chain_clip(2, frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / static_cast<double>(frames);
    clip.rotation(f, 1) =
        from_euler({6 * pi * t, 0.3 * std::sin(8 * pi * t), 0}, parse_rotation_order("ZXY"));
  }
  return clip;
}

TEST(GaussianChannels, ScalesWithTheDeviationOfTheUnwrappedChannel) {
  const Take clean = turning_clip(many);
  const Take noisy = damaged(clean, "gaussian-channels", {{"k", 0.1}}).clip;
  const RotationOrder order = clean.skeleton.rotation_order(1);
  std::vector<double> dz, dx, dy;
  for (std::size_t f = 0; f < many; ++f) {
    const double t = static_cast<double>(f) / static_cast<double>(many);
    const std::array<double, 3> truth{6 * pi * t, 0.3 * std::sin(8 * pi * t), 0};
    // The z noise is 0.54 rad, so the angle nearest to the true one is the right one.
    const auto found = to_euler_near(noisy.rotation(f, 1), order, truth);
    dz.push_back(found[0] - truth[0]);
    dx.push_back(found[1] - truth[1]);
    dy.push_back(found[2]);
  }
  EXPECT_NEAR(deviation_of(dz), 0.1 * 6 * pi / std::sqrt(12.0), 0.01)
      << "a ramp of 6 pi, not a sawtooth of 2 pi";
  EXPECT_NEAR(deviation_of(dx), 0.1 * 0.3 / std::sqrt(2.0), 0.0004);
  EXPECT_NEAR(deviation_of(dy), 0, 1e-9) << "a channel that rests stays at rest";
}

TEST(GaussianChannels, HasSixDecibelAtOneHalf) {
  const Take clean = moving_chain(4, 5000);
  const Take noisy = damaged(clean, "gaussian-channels").clip;
  const RotationOrder order = clean.skeleton.rotation_order(2);
  std::vector<double> signal, noise;
  std::array<double, 3> near{};
  for (std::size_t f = 0; f < 5000; ++f) {
    near = to_euler_near(clean.rotation(f, 2), order, near);
    signal.push_back(near[0]);
    noise.push_back(to_euler_near(noisy.rotation(f, 2), order, near)[0] - near[0]);
  }
  EXPECT_NEAR(20 * std::log10(deviation_of(signal) / deviation_of(noise)), 6.02, 0.15);
}

TEST(GaussianChannels, LeavesRootsAndRestingJointsByDefault) {
  Take clean = turning_clip(100);
  for (std::size_t f = 0; f < 100; ++f)
    clean.rotation(f, 0) = test::about_x(0.01 * static_cast<double>(f));
  const auto [noisy, report] = damaged(clean, "gaussian-channels");
  EXPECT_EQ(report.samples_damaged, 100u);
  const auto [still, still_report] = damaged(chain_clip(2, 10), "gaussian-channels");
  EXPECT_EQ(still_report.samples_damaged, 0u);
  ASSERT_EQ(still_report.notes.size(), 1u);
  EXPECT_EQ(still_report.notes[0], "no channel moves: nothing to scale the noise by");
}

TEST(Ar1, HasItsDeviationAndForgetsInItsTimeConstant) {
  const Take clean = moving_chain(1, many, 100);
  const Take noisy = damaged(clean, "ar1", {{"std_deg", 2.0}, {"time_constant_s", 0.05}}).clip;
  const auto c = components_of(errors_of(clean, noisy, 0));
  EXPECT_NEAR(deviation_of(c.x), 2 * degree, 0.12 * degree);
  EXPECT_NEAR(correlation(c.x, c.x, 1), std::exp(-0.01 / 0.05), 0.02);
  EXPECT_NEAR(correlation(c.y, c.y, 5), std::exp(-1.0), 0.05);
  EXPECT_NEAR(correlation(c.x, c.y), 0, 0.06);
}

TEST(Ar1, TakesTheCorrelationOfNeighbouringFrames) {
  const Take clean = moving_chain(1, many, 100);
  const auto lag1 = [&](double correlation_asked) {
    const auto c = components_of(
        errors_of(clean, damaged(clean, "ar1", {{"correlation", correlation_asked}}).clip, 0));
    return correlation(c.x, c.x, 1);
  };
  EXPECT_NEAR(lag1(0.0), 0, 0.03);
  EXPECT_NEAR(lag1(0.9), 0.9, 0.02);
  EXPECT_NEAR(lag1(-0.5), -0.5, 0.03);
}

TEST(Bias, IsOneTurnOfTheAngleAskedFor) {
  const Take clean = moving_chain(3, 50);
  const Take biased = damaged(clean, "bias", {{"bias_deg", 7.0}}).clip;
  std::vector<Vec3> axes;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto errors = errors_of(clean, biased, j);
    for (const Vec3 e : errors) {
      EXPECT_NEAR(norm(e), 7 * degree, 1e-12);
      EXPECT_NEAR(norm(e - errors[0]), 0, 1e-12) << "constant";
    }
    axes.push_back(errors[0]);
  }
  EXPECT_GT(norm(axes[0] - axes[1]), 0.01) << "each joint has its own axis";
  const auto about_y =
      errors_of(clean, damaged(clean, "bias", {{"axis", std::string("y")}}).clip, 1);
  EXPECT_NEAR(norm(about_y[9] - Vec3{0, 5 * degree, 0}), 0, 1e-12);
}

TEST(Sinusoid, SwingsWithItsAmplitudeAndFrequency) {
  const Take clean = moving_chain(2, 1000, 100);
  const Take biased =
      damaged(clean, "sinusoid",
              {{"amplitude_deg", 4.0}, {"frequency_hz", 0.5}, {"axis", std::string("x")}})
          .clip;
  const auto c = components_of(errors_of(clean, biased, 1));
  // Over five whole periods, the Fourier component at 0.5 Hz is the whole signal.
  double cosine = 0, sine = 0;
  for (std::size_t f = 0; f < 1000; ++f) {
    const double phase = 2 * pi * 0.5 * static_cast<double>(f) / 100;
    cosine += c.x[f] * std::cos(phase) / 500;
    sine += c.x[f] * std::sin(phase) / 500;
  }
  EXPECT_NEAR(std::hypot(cosine, sine), 4 * degree, 1e-9);
  EXPECT_NEAR(deviation_of(c.x), 4 / std::sqrt(2.0) * degree, 1e-9);
  EXPECT_NEAR(deviation_of(c.y), 0, 1e-12);
}

}  // namespace
}  // namespace kinemend
