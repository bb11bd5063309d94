// Tests of the method `bilateral`, against Courty's algorithm and its symmetries.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "classic/filter_checks.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/metrics.hpp"
#include "papers/courty2008_bilateral/bilateral_filter.hpp"
#include "translations.hpp"

namespace kinemend::test {
namespace {

// The index of a sample of a mirrored signal.
std::size_t mirrored(int i, int frames) {
  while (i < 0 || i >= frames) i = i < 0 ? -i : 2 * (frames - 1) - i;
  return static_cast<std::size_t>(i);
}

// m_-k .. m_k of section 4.1, with both distances squared, normalised over the whole mask.
template <class Sample, class Distance>
std::vector<double> mask_at(const std::vector<Sample>& x, const std::vector<double>& weights, int i,
                            int k, double sigma_t, double sigma_g, const Distance& distance) {
  const int frames = static_cast<int>(x.size());
  std::vector<double> mask;
  double sum = 0;
  for (int r = -k; r <= k; ++r) {
    const double d = distance(x[static_cast<std::size_t>(i)], x[mirrored(i + r, frames)]);
    mask.push_back(std::exp(-r * r / (2 * sigma_t * sigma_t)) *
                   std::exp(-d * d / (2 * sigma_g * sigma_g)) * weights[mirrored(i + r, frames)]);
    sum += mask.back();
  }
  for (double& m : mask) m /= sum;
  return mask;
}

// Algorithm 1 with its errors corrected: one pass, mirrored ends.
std::vector<Quat> bilateral_pass(const std::vector<Quat>& q, const std::vector<double>& weights,
                                 int k, double sigma_t, double sigma_g) {
  const int frames = static_cast<int>(q.size());
  std::vector<Quat> result;
  for (int i = 0; i < frames; ++i) {
    const auto mask = mask_at(q, weights, i, k, sigma_t, sigma_g,
                              [](Quat a, Quat b) { return angle_between(a, b); });
    Vec3 sum;
    for (int r = -k; r < k; ++r) {
      double b = 0;
      for (int j = -k; j <= k; ++j) {
        if (r >= 0 && j > r) b += mask[static_cast<std::size_t>(j + k)];
        if (r < 0 && j <= r) b -= mask[static_cast<std::size_t>(j + k)];
      }
      sum += b * log(conjugate(q[mirrored(i + r, frames)]) * q[mirrored(i + r + 1, frames)]);
    }
    result.push_back(q[static_cast<std::size_t>(i)] * exp(sum));
  }
  return result;
}

// Eq. 4.
std::vector<Vec3> bilateral_pass(const std::vector<Vec3>& x, int k, double sigma_t,
                                 double sigma_g) {
  const int frames = static_cast<int>(x.size());
  const std::vector<double> weights(x.size(), 1.0);
  std::vector<Vec3> result;
  for (int i = 0; i < frames; ++i) {
    const auto mask =
        mask_at(x, weights, i, k, sigma_t, sigma_g, [](Vec3 a, Vec3 b) { return norm(b - a); });
    Vec3 sum;
    for (int r = -k; r <= k; ++r) {
      sum += mask[static_cast<std::size_t>(r + k)] * x[mirrored(i + r, frames)];
    }
    result.push_back(sum);
  }
  return result;
}

// sigma_t of 1.5 frames at 100 Hz, k = 5 (3 sigma, rounded).
constexpr double sigma_t_s = 0.015;
BilateralOptions options_with(double sigma_g_deg, std::int64_t passes, std::string ends) {
  return {sigma_t_s, sigma_g_deg, passes, std::move(ends)};
}

TEST(Bilateral, IsCourtysAlgorithmWithItsSlipsMended) {
  for (const std::size_t frames : {2, 3, 4, 50, 300}) {
    const Take input = noisy_take(frames);
    const Take output = cleaned(input, *make_bilateral(options_with(5, 2, "mirror")));
    const std::vector<double> ones(frames, 1.0);
    for (std::size_t j = 0; j < input.joint_count(); ++j) {
      std::vector<Quat> expected = track_of(input, j);
      for (int pass = 0; pass < 2; ++pass) {
        expected = bilateral_pass(expected, ones, 5, 1.5, 5 * radians_per_degree);
      }
      for (std::size_t f = 0; f < frames; ++f) {
        EXPECT_LT(difference(output.rotation(f, j), expected[f]), 1e-12) << f << " of " << frames;
      }
    }
  }
}

TEST(Bilateral, FiltersPositionsOnTheScaleOfTheBody) {
  const Take input = noisy_take(80);
  const Take output = cleaned(input, *make_bilateral(options_with(5, 1, "mirror")));
  const double sigma = 5 * radians_per_degree * body_height(input.skeleton);
  const std::vector<Vec3> expected = bilateral_pass(point_track(input, 0), 5, 1.5, sigma);
  for (std::size_t f = 0; f < 80; ++f) {
    EXPECT_LT(norm(output.root_position(f) - expected[f]), 1e-11);
  }
}

TEST(Bilateral, GivesUnobservedSamplesNoWeight) {
  Take input = noisy_take(60);
  input.observed.assign(input.rotations.size(), 1);
  for (const std::size_t f : {0, 20, 21, 22, 40, 59}) {
    input.observed[f * input.joint_count() + 2] = 0;
  }
  const Take output = cleaned(input, *make_bilateral(options_with(5, 1, "mirror")));
  // Gaps are bridged by geodesics first.
  std::vector<Quat> track = track_of(input, 2);
  std::vector<double> weights;
  for (std::size_t f = 0; f < 60; ++f) weights.push_back(input.is_observed(f, 2) ? 1 : 0);
  track[0] = track[1];
  track[59] = track[58];
  for (const int f : {20, 21, 22}) {
    track[static_cast<std::size_t>(f)] = slerp(track[19], track[23], (f - 19) / 4.0);
  }
  track[40] = slerp(track[39], track[41], 0.5);
  const std::vector<Quat> expected = bilateral_pass(track, weights, 5, 1.5, 5 * radians_per_degree);
  for (std::size_t f = 0; f < 60; ++f) {
    if (weights[f] == 0) continue;
    EXPECT_LT(difference(output.rotation(f, 2), expected[f]), 1e-12) << f;
  }
  EXPECT_LT(difference(output.rotation(21, 2), slerp(expected[19], expected[23], 0.5)), 1e-12);
}

// Proposition 1: BOF(a q b) = a BOF(q) b.
TEST(Bilateral, IsTheSameInAnyCoordinateFrame) {
  const Take input = noisy_take(60);
  for (const char* ends : {"mirror", "reflect"}) {
    const auto cleaner = make_bilateral(options_with(5, 5, ends));
    EXPECT_LT(largest_difference(in_other_frames(cleaned(input, *cleaner), 8),
                                 cleaned(in_other_frames(input, 8), *cleaner)),
              1e-12);
  }
}

// The proposition holds for turns that are constant over the frames. A turning parent is not such a
// turn: filtering relative to it and relative to the world gives different results.
TEST(Bilateral, IsNotTheSameInTheFrameOfAParentThatTurns) {
  const Take input = noisy_take(120);
  const auto cleaner = make_bilateral(options_with(5, 5, "reflect"));
  const auto from_parent = [](Take clip, double turn_deg, double swing_deg) {
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const double t = static_cast<double>(f) / clip.frame_rate_hz;
      const double angle = radians_per_degree * (turn_deg + swing_deg * std::sin(6 * t));
      for (std::size_t j = 0; j < clip.joint_count(); ++j)
        clip.rotation(f, j) = exp({0, angle, 0}) * clip.rotation(f, j);
    }
    return clip;
  };
  const auto disagreement_deg = [&](double turn_deg, double swing_deg) {
    return degrees_per_radian *
           largest_difference(from_parent(cleaned(input, *cleaner), turn_deg, swing_deg),
                              cleaned(from_parent(input, turn_deg, swing_deg), *cleaner));
  };
  EXPECT_LT(disagreement_deg(50, 0), 1e-10);
  EXPECT_GT(disagreement_deg(50, 40), 0.5);
}

// Proposition 2. The division into blocks of frames does not change the result.
TEST(Bilateral, IsTheSameAtAnyTime) {
  const Take input = noisy_take(700);
  const auto cleaner = make_bilateral(options_with(5, 2, "reflect"));
  const Take output = cleaned(input, *cleaner);
  for (const std::size_t shift : {1, 3, 8, 250}) {
    const Take later = cleaned(slice(input, shift, 700), *cleaner);
    for (std::size_t f = shift + 10; f < 700; ++f) {
      for (std::size_t j = 0; j < input.joint_count(); ++j) {
        ASSERT_EQ(later.rotation(f - shift, j), output.rotation(f, j)) << f;
      }
      ASSERT_EQ(later.root_position(f - shift), output.root_position(f)) << f;
    }
  }
}

TEST(Bilateral, IsTheSameBackwardsInTime) {
  const Take input = noisy_take(60);
  for (const char* ends : {"mirror", "reflect"}) {
    const auto cleaner = make_bilateral(options_with(5, 5, ends));
    EXPECT_LT(
        largest_difference(reversed(cleaned(input, *cleaner)), cleaned(reversed(input), *cleaner)),
        1e-11);
  }
}

TEST(Bilateral, OfManyPassesIsOnePassManyTimes) {
  const Take input = noisy_take(60);
  Take expected = input;
  for (int pass = 0; pass < 4; ++pass) {
    expected = cleaned(expected, *make_bilateral(options_with(5, 1, "reflect")));
  }
  EXPECT_EQ(
      largest_difference(expected, cleaned(input, *make_bilateral(options_with(5, 4, "reflect")))),
      0.0);
}

// A turn of 40 degrees from one frame to the next, under noise of 1 degree.
Take stepping_take(double noise_deg, std::uint64_t seed) {
  Take clip = held_take(80, noise_deg, seed);
  for (std::size_t f = 40; f < 80; ++f) {
    clip.rotation(f, 0) = exp({40 * radians_per_degree, 0, 0}) * clip.rotation(f, 0);
  }
  return clip;
}

TEST(Bilateral, KeepsAnEdgeThatAGaussianMelts) {
  const Take truth = stepping_take(0, 3), input = stepping_take(1, 3);
  const Take output = cleaned(input, *make_bilateral({0.02, 8, 5, "reflect"}));
  const Take melted = cleaned(input, *make_gaussian({0.02 * std::sqrt(5.0)}));
  const auto step_deg = [](const Take& clip) {
    return degrees_per_radian * angle_between(clip.rotation(39, 0), clip.rotation(40, 0));
  };
  EXPECT_NEAR(step_deg(output), 40, 1.5);
  EXPECT_LT(step_deg(melted), 10);
  EXPECT_LT(rms_angle_deg(truth, output), 0.5 * rms_angle_deg(truth, input));
}

TEST(Bilateral, KeepsALoneSpike) {
  Take input = held_take(60, 0.5, 4);
  input.rotation(30, 0) = input.rotation(30, 0) * exp({0, 0.6, 0});
  const Take output = cleaned(input, *make_bilateral({0.02, 5, 5, "reflect"}));
  EXPECT_GT(angle_between(output.rotation(30, 0), output.rotation(28, 0)), 0.55);
}

TEST(Bilateral, IsAGaussianWhenNoTurnIsLarge) {
  const Take input = noisy_take(60);
  const Take output = cleaned(input, *make_bilateral(options_with(1000, 1, "mirror")));
  // The mask has 5 frames on either side.
  double sum = 0;
  std::vector<double> mask;
  for (int j = -5; j <= 5; ++j) sum += std::exp(-j * j / 4.5);
  for (std::size_t f = 5; f < 55; ++f) {
    Vec3 mean;
    for (int j = -5; j <= 5; ++j) {
      mean += (std::exp(-j * j / 4.5) / sum) *
              input.root_position(static_cast<std::size_t>(static_cast<int>(f) + j));
    }
    EXPECT_LT(norm(output.root_position(f) - mean), 1e-4);
  }
}

TEST(Bilateral, ReflectedKeepsASteadyTurnUpToTheEndsAndMirroredBendsIt) {
  Take input = held_take(60, 0, 1);
  for (std::size_t f = 0; f < 60; ++f) {
    input.rotation(f, 0) = exp({0.02 * static_cast<double>(f), 0, 0}) * input.rotation(f, 0);
    input.root_position(f) = {0.3 * static_cast<double>(f), 0, 1};
  }
  EXPECT_LT(largest_difference(input, cleaned(input, *make_bilateral({0.02, 8, 5, "reflect"}))),
            1e-12);
  const Take bent = cleaned(input, *make_bilateral({0.02, 8, 5, "mirror"}));
  EXPECT_GT(angle_between(input.rotation(0, 0), bent.rotation(0, 0)), 0.02);
}

// Weights underflow to denormal numbers and to zero.
TEST(Bilateral, StaysFiniteWhereNothingIsNear) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    Take input = held_take(12, 0, 1);
    for (Quat& q : input.rotations) q = random_rotation(random);
    for (std::size_t f = 0; f < input.frame_count(); ++f)
      input.root_position(f) = random_vector(random, 3);
    for (const double sigma_g_deg : {0.01, 1.0, 2.0, 2.5, 3.0, 4.0, 6.0, 1000.0}) {
      for (const char* ends : {"mirror", "reflect"}) {
        EXPECT_NO_THROW(cleaned(input, *make_bilateral({0.03, sigma_g_deg, 5, ends})).validate());
      }
    }
  }
}

TEST(Bilateral, BeatsItsNoisyInput) {
  const Take truth = moving_take(400, 120);
  Take input = truth;
  add_noise(input, 2, 0.5, 9);
  const Take output = cleaned(input, *make_bilateral());
  EXPECT_LT(rms_angle_deg(truth, output), 0.5 * rms_angle_deg(truth, input));
}

TEST(Bilateral, DependsOnItsWindowOnly) {
  const auto cleaner = make_bilateral(options_with(5, 3, "reflect"));
  ASSERT_EQ(cleaner->live(view_of(noisy_take(1)))->lookahead(), 15U);
  const Take input = noisy_take(80);
  const Take output = cleaned(input, *cleaner), other = cleaned(changed_at(input, 40), *cleaner);
  EXPECT_EQ(output.rotation(24, 1), other.rotation(24, 1));
  EXPECT_EQ(output.rotation(56, 1), other.rotation(56, 1));
  EXPECT_NE(output.rotation(36, 1), other.rotation(36, 1));
}

TEST(Bilateral, RefusesOptionsThatMakeNoSense) {
  EXPECT_THROW(make_bilateral({0, 6, 5, "mirror"}), Error);
  EXPECT_THROW(make_bilateral({0.01, 0, 5, "mirror"}), Error);
  EXPECT_THROW(make_bilateral({0.01, 6, 0, "mirror"}), Error);
  EXPECT_THROW(make_bilateral({0.01, 6, 5, "wrapped"}), Error);
}

}  // namespace
}  // namespace kinemend::test
