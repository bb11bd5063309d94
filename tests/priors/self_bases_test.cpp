#include "priors/self_bases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinemend/random.hpp"

namespace kinemend {
namespace {

// Two swings that all channels share, four patterns in windows, under noise.
PoseMatrix noisy_swing(std::size_t frames, double size, const std::vector<double>& noise,
                       double rate_hz) {
  Random body(1), random(2);
  PoseMatrix poses(frames, noise.size());
  for (std::size_t c = 0; c < noise.size(); ++c) {
    const double one = size * body.normal(), two = size * body.normal();
    const double phase = 6.28 * body.uniform();
    for (std::size_t f = 0; f < frames; ++f) {
      const double t = static_cast<double>(f) / rate_hz;
      poses(f, c) = 30 + one * std::sin(7 * t + phase) + two * std::cos(15 * t + phase) +
                    noise[c] * random.normal();
    }
  }
  return poses;
}

TEST(SelfBases, AreThePatternsThatStandOutOfTheNoise) {
  const std::vector<double> noise = {1, 1, 2, 0.5, 1, 3, 1, 1};
  const ExamplePrior prior = self_bases(noisy_swing(1200, 10, noise, 30), 30, noise);
  EXPECT_EQ(prior.bases.count, 4u);
  EXPECT_EQ(prior.bases.window_frames, 20u);
  EXPECT_EQ(prior.rate_hz, 30);
}

TEST(SelfBases, AreNoneOfNoiseAlone) {
  const std::vector<double> noise = {1, 1, 2, 0.5, 1, 3, 1, 1};
  EXPECT_EQ(self_bases(noisy_swing(1200, 0, noise, 30), 30, noise).bases.count, 0u);
}

TEST(SelfBases, AreLearnedAtAboutThirtyHertz) {
  EXPECT_EQ(self_rate_hz(120), 30);
  EXPECT_EQ(self_rate_hz(60), 30);
  EXPECT_NEAR(self_rate_hz(100), 100.0 / 3, 1e-12);
  EXPECT_EQ(self_rate_hz(24), 24);
  const std::vector<double> noise(6, 1.0);
  EXPECT_EQ(self_bases(noisy_swing(4000, 10, noise, 120), 120, noise).bases.count, 4u);
}

TEST(SelfBases, AreNoneOfATakeThatHasNoTwoWindows) {
  const std::vector<double> noise(6, 1.0);
  for (const std::size_t frames : {0, 1, 5, 39}) {
    EXPECT_EQ(self_bases(noisy_swing(frames, 10, noise, 30), 30, noise).bases.count, 0u);
  }
}

TEST(SelfBases, HaveTheVariancesOfTheMotionWithoutTheNoise) {
  const std::vector<double> none(8, 1e-3), noise(8, 2.0);
  const ExamplePrior clean =
      self_bases(noisy_swing(3000, 10, none, 30), 30, std::vector<double>(8, 2.0), 4);
  const ExamplePrior noisy = self_bases(noisy_swing(3000, 10, noise, 30), 30, noise);
  ASSERT_EQ(noisy.bases.count, 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(noisy.bases.eigenvalues[k] / clean.bases.eigenvalues[k], 1, 0.02);
  }
}

}  // namespace
}  // namespace kinemend
