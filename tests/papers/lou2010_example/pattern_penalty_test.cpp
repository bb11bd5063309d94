// Tests of the distance from patterns: computation by windows and by frequencies agrees.
#include "papers/lou2010_example/pattern_penalty.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "dense_algebra.hpp"
#include "papers/lou2010_example/window_support.hpp"
#include "random_values.hpp"

namespace kinemend {
namespace {

using Product = PatternPenalty::Product;

PoseMatrix random_poses(std::size_t frames, std::size_t channels, std::uint64_t seed) {
  PoseMatrix poses(frames, channels);
  poses.values = test::random_values(frames * channels, seed);
  return poses;
}

// sum_s min_c, with a least-squares solution for each window.
double brute_penalty(const WindowBases& bases, const std::vector<double>& weights,
                     const std::vector<double>& ridge, const PoseMatrix& z, std::size_t windows) {
  const Eigen::MatrixXd E = matrix_of(bases);
  const auto rows = E.rows(), count = E.cols();
  double total = 0;
  for (std::size_t s = 0; s < windows; ++s) {
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + count, count);
    Eigen::VectorXd target = Eigen::VectorXd::Zero(rows + count);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const double d = std::sqrt(weights[r % bases.channels]);
      system.row(r) = d * E.row(r);
      target[r] = d * z.values[s * bases.hop * bases.channels + r];
    }
    for (Eigen::Index k = 0; k < count; ++k) system(rows + k, k) = std::sqrt(ridge[k]);
    const Eigen::VectorXd c = test::least_squares(system, target);
    total += (target - system * c).squaredNorm();
  }
  return total;
}

// The largest difference of the two products, relative to the largest value.
double largest_difference(const WindowBases& bases, std::size_t frames) {
  const std::vector<double> weights(bases.channels, 1.5);
  PatternPenalty windows(bases, weights, {}, frames, 1, Product::windows);
  PatternPenalty frequencies(bases, weights, {}, frames, 1, Product::frequencies);
  const PoseMatrix z = random_poses(windows.padded_frames(), bases.channels, 3);
  PoseMatrix expected = z, found = z;
  windows.multiply(z, expected);
  frequencies.multiply(z, found);
  double size = 0, most = 0;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    size = std::max(size, std::abs(expected.values[i]));
    // The negated comparison catches NaN too.
    const double difference = std::abs(found.values[i] - expected.values[i]);
    if (!(difference <= most)) most = difference;
  }
  return most / size;
}

TEST(PatternPenalty, IsWhatTheBestCoefficientsOfAllWindowsLeave) {
  for (const Product product : {Product::windows, Product::frequencies}) {
    for (const std::size_t hop : {1, 2, 3}) {
      const WindowBases bases = random_bases(8, hop, 3, 5, 1);
      const std::vector<double> weights = {1.0, 0.3, 4.0}, ridge = {0.0, 1.0, 0.1, 3.0, 0.5};
      const std::size_t frames = 8 + 5 * hop;
      PatternPenalty penalty(bases, weights, ridge, frames, 1, product);
      EXPECT_EQ(penalty.windows(), 6u);
      const PoseMatrix z = random_poses(penalty.padded_frames(), 3, 2);
      PoseMatrix image = z;
      penalty.multiply(z, image);
      double found = 0;
      for (std::size_t i = 0; i < z.values.size(); ++i) {
        found += z.values[i] * (penalty.diagonal(i / 3, i % 3) * z.values[i] - image.values[i]);
      }
      EXPECT_NEAR(found, brute_penalty(bases, weights, ridge, z, 6), 1e-7 * found) << "hop " << hop;
    }
  }
}

TEST(PatternPenalty, IsTheSameByWindowsAndByFrequencies) {
  for (const std::size_t window : {1UL, 2UL, 5UL, 20UL}) {
    for (const std::size_t hop : {1UL, 3UL}) {
      for (const std::size_t channels : {4UL, 26UL}) {
        for (const std::size_t more : {0UL, 1UL, 7UL, 50UL, 300UL}) {
          const std::size_t frames = window + more;
          const WindowBases bases = random_bases(window, hop, channels, 4, window + hop);
          ASSERT_LE(largest_difference(bases, frames), 1e-13)
              << window << " frames, hop " << hop << ", " << frames << " in all";
        }
      }
    }
  }
}

TEST(PatternPenalty, IsTheSameWithBasesThatStayAtTheModelsRate) {
  FilterBases bases;
  bases.window_frames = 6, bases.channels = 3, bases.count = 4;
  bases.bases = test::random_values(6 * 3 * 4, 2);
  const std::vector<double> weights = {1.0, 0.3, 4.0};
  for (const std::vector<double>& ridge : {std::vector<double>{}, {0.1, 1.0, 0.2, 0.5}}) {
    for (const double rate_hz : {40.0, 170.0, 1000.0}) {
      for (const std::size_t frames : {160UL, 250UL, 601UL}) {
        const WindowBases sampled = bases_at_rate(bases, 30, rate_hz, frames);
        const WindowBases kept = bases_at_rate(bases, 30, rate_hz, frames, 0, 0);
        ASSERT_FALSE(sampled.is_interpolated());
        ASSERT_TRUE(kept.is_interpolated());
        EXPECT_EQ(kept.values, bases.bases);
        PatternPenalty by_clip(sampled, weights, ridge, frames, 1, Product::windows);
        PatternPenalty by_model(kept, weights, ridge, frames);
        ASSERT_EQ(by_model.padded_frames(), by_clip.padded_frames());
        const PoseMatrix z = random_poses(by_clip.padded_frames(), 3, 3);
        PoseMatrix expected = z, found = z;
        by_clip.multiply(z, expected);
        by_model.multiply(z, found);
        for (std::size_t i = 0; i < z.values.size(); ++i) {
          ASSERT_NEAR(found.values[i], expected.values[i], 1e-9) << rate_hz << " Hz, " << frames;
          ASSERT_EQ(by_model.diagonal(i / 3, i % 3), by_clip.diagonal(i / 3, i % 3));
        }
      }
    }
  }
}

// Matrices of 17 MB are stored in single precision.
TEST(PatternPenalty, IsTheSameButForSinglePrecisionWhereMatricesAreLarge) {
  const std::size_t channels = 520, frames = 60;
  const double difference = largest_difference(random_bases(2, 1, channels, 4, 5), frames);
  EXPECT_LT(difference, 1e-6);
  EXPECT_GT(difference, 1e-12) << "kept in double precision";
}

TEST(PatternPenalty, GoesByFrequenciesWhereThereAreManyBasesAndManyProducts) {
  const std::vector<double> weights(12, 1.0);
  const auto by_frequencies = [&](std::size_t bases, std::size_t frames, std::size_t products) {
    return PatternPenalty(random_bases(20, 1, 12, bases, 1), weights, {}, frames, products)
        .goes_by_frequencies();
  };
  EXPECT_TRUE(by_frequencies(60, 300, 15));
  EXPECT_FALSE(by_frequencies(60, 50, 1));
  EXPECT_FALSE(by_frequencies(60, 20, 15));
  EXPECT_FALSE(by_frequencies(2, 300, 15));
}

TEST(PatternPenalty, TakesOrthonormalBasesAsTheyAre) {
  WindowBases bases = random_bases(6, 1, 3, 4, 7);
  const Eigen::MatrixXd q = test::orthonormal(matrix_of(bases));
  for (std::size_t i = 0; i < bases.values.size(); ++i) bases.values[i] = q(i / 4, i % 4);
  const std::vector<double> ones(3, 1.0), others(3, 2.0);
  for (const std::vector<double>& weights : {ones, others}) {
    bases.orthonormal = false;
    PatternPenalty any(bases, weights, {}, 20);
    bases.orthonormal = true;
    PatternPenalty known(bases, weights, {}, 20);
    const PoseMatrix z = random_poses(20, 3, 8);
    PoseMatrix expected = z, found = z;
    any.multiply(z, expected);
    known.multiply(z, found);
    for (std::size_t i = 0; i < found.values.size(); ++i)
      EXPECT_NEAR(found.values[i], expected.values[i], 1e-9);
  }
}

TEST(PatternPenalty, CoversClipsThatAreNoWholeNumberOfHops) {
  const WindowBases bases = random_bases(7, 3, 2, 3, 1);
  for (std::size_t frames = 7; frames < 20; ++frames) {
    const PatternPenalty penalty(bases, std::vector<double>{1, 1}, {}, frames);
    ASSERT_GE(penalty.padded_frames(), frames);
    for (std::size_t f = 0; f < frames; ++f) EXPECT_GT(penalty.diagonal(f, 0), 0) << f;
  }
}

}  // namespace
}  // namespace kinemend
