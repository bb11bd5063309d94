// Tests of means of rotations, by brute force and against NumPy.
#include <gtest/gtest.h>

#include <map>

#include "base/csv.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::random_rotation;
using test::random_vector;

struct Sample {
  std::vector<Quat> rotations;
  std::vector<double> weights;
};

Sample spread_sample(Random& random, std::size_t count, double spread) {
  Sample sample;
  const Quat centre = random_rotation(random);
  for (std::size_t i = 0; i < count; ++i) {
    const Quat q = centre * exp(random_vector(random, spread));
    sample.rotations.push_back(random.chance(0.5) ? q : -q);
    sample.weights.push_back(random.uniform(0.1, 2));
  }
  return sample;
}

double sum_of_squares(Quat mean, const Sample& sample) {
  double sum = 0;
  for (std::size_t i = 0; i < sample.rotations.size(); ++i) {
    const double angle = angle_between(mean, sample.rotations[i]);
    sum += sample.weights[i] * angle * angle;
  }
  return sum;
}

// Descends from every sample by trial steps of shrinking length.
Quat brute_force_mean(const Sample& sample) {
  Quat best = sample.rotations[0];
  for (const Quat start : sample.rotations) {
    Quat q = start;
    for (double step = 0.5; step > 1e-9; step /= 2) {
      for (bool better = true; better;) {
        better = false;
        for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                                     Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
          const Quat trial = q * exp(step * direction);
          if (sum_of_squares(trial, sample) < sum_of_squares(q, sample)) {
            q = trial;
            better = true;
          }
        }
      }
    }
    if (sum_of_squares(q, sample) < sum_of_squares(best, sample)) best = q;
  }
  return best;
}

TEST(KarcherMean, IsTheLeastSumOfSquaresByBruteForce) {
  Random random(1);
  for (const double spread : {0.01, 0.2, 0.4}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Sample sample = spread_sample(random, 5, spread);
      const Quat mean = karcher_mean(sample.rotations, sample.weights);
      EXPECT_LT(angle_between(mean, brute_force_mean(sample)), 1e-6);
      Vec3 gradient;
      for (std::size_t i = 0; i < 5; ++i)
        gradient += sample.weights[i] * log(conjugate(mean) * sample.rotations[i]);
      EXPECT_LT(norm(gradient), 1e-12);
    }
  }
}

TEST(KarcherMean, OfTwoRotationsIsHalfWay) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Quat a = random_rotation(random), b = a * exp(random_vector(random, 0.7));
    EXPECT_LT(angle_between(karcher_mean(std::vector{a, b}), slerp(a, b, 0.5)), 1e-12);
    EXPECT_LT(
        angle_between(karcher_mean(std::vector{a, b}, std::vector{3.0, 1.0}), slerp(a, b, 0.25)),
        1e-12);
  }
}

TEST(KarcherMean, MovesWithTheFrameOfCoordinates) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Sample sample = spread_sample(random, 7, 0.4);
    const Quat left = random_rotation(random), right = random_rotation(random);
    std::vector<Quat> moved;
    for (const Quat q : sample.rotations) moved.push_back(left * q * right);
    const Quat mean = karcher_mean(sample.rotations, sample.weights);
    EXPECT_LT(angle_between(karcher_mean(moved, sample.weights), left * mean * right), 1e-12);
  }
}

TEST(Means, OfNothingAreTheIdentityAndOfOneItself) {
  EXPECT_EQ(karcher_mean({}), Quat{});
  EXPECT_EQ(chordal_mean({}), Quat{});
  const std::vector<Quat> one{test::about_x(3.0)};
  EXPECT_LT(angle_between(karcher_mean(one), one[0]), 1e-15);
  EXPECT_LT(angle_between(chordal_mean(one), one[0]), 1e-15);
  EXPECT_LT(angle_between(log_mean({}, one), one[0]), 1e-15);
}

TEST(Means, AreIndifferentToSignsAndZeroWeights) {
  Random random(4);
  Sample sample = spread_sample(random, 6, 0.4);
  Sample flipped = sample;
  for (std::size_t i = 0; i < 6; i += 2) flipped.rotations[i] = -flipped.rotations[i];
  EXPECT_LT(angle_between(karcher_mean(sample.rotations, sample.weights),
                          karcher_mean(flipped.rotations, sample.weights)),
            1e-14);
  EXPECT_LT(angle_between(chordal_mean(sample.rotations), chordal_mean(flipped.rotations)), 1e-14);
  const Quat mean = karcher_mean(sample.rotations, sample.weights);
  sample.rotations.push_back(random_rotation(random));
  sample.weights.push_back(0);
  EXPECT_LT(angle_between(karcher_mean(sample.rotations, sample.weights), mean), 1e-12);
}

TEST(Means, DoNotDependOnTheScaleOfTheWeights) {
  Random random(5);
  const Sample sample = spread_sample(random, 6, 0.5);
  for (const double scale : {1e-200, 1e-12, 1e12, 1e150}) {
    std::vector<double> weights;
    for (const double w : sample.weights) weights.push_back(scale * w);
    EXPECT_LT(angle_between(karcher_mean(sample.rotations, weights),
                            karcher_mean(sample.rotations, sample.weights)),
              1e-12)
        << scale;
    EXPECT_LT(angle_between(chordal_mean(sample.rotations, weights),
                            chordal_mean(sample.rotations, sample.weights)),
              1e-12)
        << scale;
  }
}

TEST(LogMean, IsTheMeanInTheTangentOfItsReference) {
  const Quat r = test::about_z(0.4);
  const std::vector<Vec3> tangents{{0.3, 0, 0.1}, {-0.1, 0.5, 0}, {0, 0.2, -0.4}};
  std::vector<Quat> rotations;
  for (const Vec3 v : tangents) rotations.push_back(r * exp(v));
  const std::vector<double> weights{1, 2, 5};
  const Vec3 expected = 0.125 * (1.0 * tangents[0] + 2.0 * tangents[1] + 5.0 * tangents[2]);
  EXPECT_LT(norm(log(conjugate(r) * log_mean(r, rotations, weights)) - expected), 1e-15);
}

TEST(ChordalMean, AgreesWithNumpysEigenvector) {
  std::map<int, Sample> sets;
  std::map<int, Quat> means;
  for (const auto& row : test::read_csv("rotation/chordal_means.csv")) {
    const int set = std::stoi(row[0]);
    const Quat q{std::stod(row[2]), std::stod(row[3]), std::stod(row[4]), std::stod(row[5])};
    const double weight = std::stod(row[1]);
    if (weight < 0) {
      means[set] = q;
    } else {
      sets[set].rotations.push_back(q);
      sets[set].weights.push_back(weight);
    }
  }
  ASSERT_EQ(means.size(), 5u);
  for (const auto& [set, mean] : means) {
    EXPECT_LT(angle_between(chordal_mean(sets[set].rotations, sets[set].weights), mean), 1e-13)
        << "set " << set;
  }
}

TEST(ChordalMean, OfASymmetricSetStaysInItsSpan) {
  // Between identity and a half turn about x, any turn about x is a leading eigenvector.
  const Quat mean = chordal_mean(std::vector<Quat>{{1, 0, 0, 0}, {0, 1, 0, 0}});
  EXPECT_NEAR(std::hypot(mean.w, mean.x), 1, 1e-12);
}

}  // namespace
}  // namespace kinemend
