// Tests of the method `gaussian` and of the kernels of orientation filters.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "classic/filter_checks.hpp"
#include "cleaner/orientation_filter.hpp"
#include "hwy/targets.h"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"

namespace kinemend::test {
namespace {

// Angles from almost zero to almost a half turn.
const std::vector<double> hard_angles{0,   1e-300, 1e-160, 1e-12, 1e-8, 1e-5,     1e-3,
                                      0.1, 0.7,    1.5,    2.5,   3.1,  3.141592, pi - 1e-9};

TEST(OrientationFilter, TakesLogarithmsAsTheMathLibraryDoes) {
  Random random(1);
  std::vector<Quat> samples;
  for (const double angle : hard_angles) {
    for (int i = 0; i < 20; ++i) {
      const Quat q = random_rotation(random);
      const Vec3 v = random_vector(random);
      samples.push_back(q);
      samples.push_back(q * exp((angle / norm(v)) * v));
      if (i % 2) samples.back() = -samples.back();
    }
  }
  RotationTrack track(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) track.set(i, samples[i]);
  const VectorTrack steps = increments(track);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
    const Vec3 expected = log(conjugate(samples[i]) * samples[i + 1]);
    EXPECT_LT(norm(steps[i] - expected), 3e-14) << "angle " << norm(expected);
  }
}

TEST(OrientationFilter, FindsNoTurnBetweenEqualRotations) {
  Random random(2);
  RotationTrack track(99);
  const Quat q = random_rotation(random);
  for (std::size_t i = 0; i < track.frames; ++i) track.set(i, i % 3 ? q : -q);
  const VectorTrack steps = increments(track);
  for (std::size_t i = 0; i < track.frames; ++i) EXPECT_EQ(norm(steps[i]), 0.0);
}

TEST(OrientationFilter, TurnsAsTheMathLibraryDoes) {
  Random random(3);
  std::vector<double> angles = hard_angles;
  for (const double more : {pi, 4.0, 2 * pi, 10.0, 100.0, 1000.0}) angles.push_back(more);
  for (const double angle : angles) {
    RotationTrack track(1);
    VectorTrack turns(1);
    const Quat q = random_rotation(random);
    const Vec3 v = random_vector(random);
    track.set(0, q);
    turns.set(0, (angle / norm(v)) * v);
    turn(track, turns);
    const Quat expected = q * exp((angle / norm(v)) * v);
    EXPECT_LT(difference(track[0], expected), 2e-15 + 1e-15 * angle) << "angle " << angle;
    EXPECT_NEAR(norm(track[0]), 1.0, 2e-15);
    EXPECT_GE(dot(track[0], q), -1e-15);
  }
}

TEST(OrientationFilter, GivesTheSameBitsOnEveryProcessor) {
  const Take input = noisy_take(100);
  std::vector<std::unique_ptr<Cleaner>> cleaners;
  cleaners.push_back(make_gaussian());
  cleaners.push_back(make_bilateral());
  cleaners.push_back(make_nonlocal());
  for (const auto& cleaner : cleaners) {
    const Take expected = cleaned(input, *cleaner);
    const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    ASSERT_FALSE(targets.empty());
    for (const std::int64_t target : targets) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(target);
      const Take output = cleaned(input, *cleaner);
      EXPECT_EQ(output.rotations, expected.rotations) << hwy::TargetName(target);
      EXPECT_EQ(output.positions, expected.positions) << hwy::TargetName(target);
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
  }
}

// Courty's eq. 2 and 3 with the sign rule of Lee & Shin.
Quat oriented(const std::vector<Quat>& q, std::size_t i, const std::vector<double>& mask) {
  const int k = static_cast<int>(mask.size() / 2);
  Vec3 sum;
  for (int r = -k; r < k; ++r) {
    double b = 0;
    if (r < 0) {
      for (int j = -k; j <= r; ++j) b -= mask[static_cast<std::size_t>(j + k)];
    } else {
      for (int j = r + 1; j <= k; ++j) b += mask[static_cast<std::size_t>(j + k)];
    }
    const std::size_t at = static_cast<std::size_t>(static_cast<int>(i) + r);
    sum += b * log(conjugate(q[at]) * q[at + 1]);
  }
  return q[i] * exp(sum);
}

std::vector<double> gaussian_mask(double sigma) {
  const int k = static_cast<int>(std::lround(4 * sigma));
  std::vector<double> mask;
  for (int j = -k; j <= k; ++j) mask.push_back(std::exp(-j * j / (2 * sigma * sigma)));
  const double sum = std::accumulate(mask.begin(), mask.end(), 0.0);
  for (double& m : mask) m /= sum;
  return mask;
}

TEST(Gaussian, IsLeeAndShinsFilterWithAGaussianMask) {
  const Take input = noisy_take(60);
  const Take output = cleaned(input, *make_gaussian({0.03}));
  const std::vector<double> mask = gaussian_mask(3);
  ASSERT_EQ(mask.size(), 25U);
  for (std::size_t j = 0; j < input.joint_count(); ++j) {
    const std::vector<Quat> track = track_of(input, j);
    for (std::size_t f = 12; f < 48; ++f) {
      EXPECT_LT(difference(output.rotation(f, j), oriented(track, f, mask)), 1e-13);
    }
  }
  for (std::size_t f = 12; f < 48; ++f) {
    Vec3 root, prop;
    for (std::size_t m = 0; m < mask.size(); ++m) {
      root += mask[m] * input.root_position(f + m - 12);
      prop += mask[m] * input.position(f + m - 12, 1);
    }
    EXPECT_LT(norm(output.root_position(f) - root), 1e-12);
    EXPECT_LT(norm(output.position(f, 1) - prop), 1e-12);
  }
}

// The value at t = 0 of the weighted least-squares line, by its normal equations.
double line_at_zero(const std::vector<double>& t, const std::vector<double>& x,
                    const std::vector<double>& weights) {
  std::array<double, 5> s{};  // of w, wt, wtt, wx, wtx
  for (std::size_t i = 0; i < t.size(); ++i) {
    s[0] += weights[i];
    s[1] += weights[i] * t[i];
    s[2] += weights[i] * t[i] * t[i];
    s[3] += weights[i] * x[i];
    s[4] += weights[i] * t[i] * x[i];
  }
  return (s[2] * s[3] - s[1] * s[4]) / (s[0] * s[2] - s[1] * s[1]);
}

TEST(Gaussian, FitsALineWhereItsWindowIsCut) {
  const Take input = noisy_take(40);
  const Take output = cleaned(input, *make_gaussian({0.03}));
  for (const std::size_t f : {0, 1, 5, 11, 28, 34, 39}) {
    std::vector<double> t, x, weights;
    for (int i = std::max(0, static_cast<int>(f) - 12); i <= std::min(39, static_cast<int>(f) + 12);
         ++i) {
      t.push_back(i - static_cast<int>(f));
      x.push_back(input.root_position(static_cast<std::size_t>(i)).y);
      weights.push_back(std::exp(-t.back() * t.back() / 18));
    }
    EXPECT_NEAR(output.root_position(f).y, line_at_zero(t, x, weights), 1e-11) << "frame " << f;
  }
}

TEST(Gaussian, TakesOffAsMuchNoiseAsItsMaskSays) {
  const Take input = held_take(4000, 1, 5);
  const Take output = cleaned(input, *make_gaussian({0.03}));
  const Take truth = held_take(4000, 0, 5);
  double expected = 0;
  for (const double m : gaussian_mask(3)) expected += m * m;
  const double before = rms_angle_deg(truth, input), after = rms_angle_deg(truth, output);
  EXPECT_NEAR(after / before, std::sqrt(expected), 0.05 * std::sqrt(expected));
}

TEST(Gaussian, LessensTheNoiseOfTheFirstAndTheLastFrame) {
  double before = 0, after = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Take truth = held_take(60, 0, seed), input = held_take(60, 1, seed);
    const Take output = cleaned(input, *make_gaussian({0.03}));
    for (const std::size_t f : {0, 59}) {
      before += std::pow(angle_between(truth.rotation(f, 0), input.rotation(f, 0)), 2);
      after += std::pow(angle_between(truth.rotation(f, 0), output.rotation(f, 0)), 2);
    }
  }
  EXPECT_LT(std::sqrt(after), 0.75 * std::sqrt(before));
}

TEST(Gaussian, IsTheSameInAnyCoordinateFrame) {
  const Take input = noisy_take(60);
  const auto cleaner = make_gaussian({0.03});
  EXPECT_LT(largest_difference(in_other_frames(cleaned(input, *cleaner), 8),
                               cleaned(in_other_frames(input, 8), *cleaner)),
            1e-13);
}

TEST(Gaussian, IsTheSameBackwardsInTime) {
  const Take input = noisy_take(60);
  const auto cleaner = make_gaussian({0.03});
  EXPECT_LT(
      largest_difference(reversed(cleaned(input, *cleaner)), cleaned(reversed(input), *cleaner)),
      1e-11);
}

TEST(Gaussian, InterpolatesGapsBetweenWhatItCleaned) {
  Take input = noisy_take(60);
  input.observed.assign(input.rotations.size(), 1);
  for (std::size_t f = 20; f < 24; ++f) input.observed[f * input.joint_count() + 2] = 0;
  Take output = input;
  const InPlaceTrace trace = clean_in_place(*make_gaussian({0.03}), output);
  const Quat before = output.rotation(19, 2), behind = output.rotation(24, 2);
  for (std::size_t f = 20; f < 24; ++f) {
    const double t = (static_cast<double>(f) - 19) / 5;
    EXPECT_LT(difference(output.rotation(f, 2), slerp(before, behind, t)), 1e-12);
    EXPECT_EQ(trace.actions[2][f], Action::filled);
  }
  // Far from the gap the result is that without a gap; near the gap, missing samples have no
  // weight.
  Take whole = input;
  whole.observed.clear();
  whole = cleaned(whole, *make_gaussian({0.03}));
  EXPECT_EQ(output.rotation(7, 2), whole.rotation(7, 2));
  EXPECT_GT(difference(output.rotation(18, 2), whole.rotation(18, 2)), 1e-4);
}

TEST(Gaussian, DependsOnItsWindowOnly) {
  const auto cleaner = make_gaussian({0.03});
  ASSERT_EQ(cleaner->live(view_of(noisy_take(1)))->lookahead(), 12U);
  const Take input = noisy_take(60);
  const Take output = cleaned(input, *cleaner), other = cleaned(changed_at(input, 30), *cleaner);
  EXPECT_EQ(output.rotation(17, 1), other.rotation(17, 1));
  EXPECT_EQ(output.rotation(43, 1), other.rotation(43, 1));
  EXPECT_NE(output.rotation(18, 1), other.rotation(18, 1));
  EXPECT_NE(output.rotation(42, 1), other.rotation(42, 1));
}

TEST(Gaussian, ChangesNothingWhenItsMaskIsOneFrame) {
  const Take input = noisy_take(30);
  EXPECT_EQ(cleaned(input, *make_gaussian({0})).rotations, input.rotations);
  EXPECT_EQ(cleaned(input, *make_gaussian({0.001})).rotations, input.rotations);
}

TEST(Gaussian, RefusesAWidthThatIsNone) {
  EXPECT_THROW(make_gaussian({-0.01}), Error);
  EXPECT_THROW(make_gaussian({std::nan("")}), Error);
}

}  // namespace
}  // namespace kinemend::test
