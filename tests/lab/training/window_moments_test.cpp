// Tests of moments and directions of windows.
#include "lab/training/window_moments.hpp"

#include <gtest/gtest.h>

#include "classic/dynamics_support.hpp"
#include "lab/training/training_sequences.hpp"

namespace kinemend::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(WindowMoments, AreThoseOfAllWindowsByTheirWeights) {
  Random random(1);
  const MatrixXd a = random_matrix(random, 3, 5), b = random_matrix(random, 3, 4);
  WindowMoments moments(3), more(3);
  moments.add(a, 0.5);
  more.add(b);
  moments.add(more);
  const VectorXd mean = (0.5 * a.rowwise().sum() + b.rowwise().sum()) / 6.5;
  EXPECT_LT((moments.mean() - mean).norm(), 1e-12);
  const VectorXd centre = random_matrix(random, 3, 1);
  const MatrixXd from_a = a.colwise() - centre, from_b = b.colwise() - centre;
  const MatrixXd expected = (0.5 * from_a * from_a.transpose() + from_b * from_b.transpose()) / 6.5;
  EXPECT_LT((moments.about(centre) - expected).norm(), 1e-12);
}

// Mean squares of the second set after projection on the leading directions of the first.
VectorXd left_by_projection(const MatrixXd& learned, const MatrixXd& held, Index rank) {
  const VectorXd mean = learned.rowwise().mean();
  const MatrixXd spread = learned.colwise() - mean;
  const MatrixXd directions =
      leading_directions(spread * spread.transpose() / static_cast<double>(learned.cols()), rank)
          .vectors;
  const MatrixXd from_mean = held.colwise() - mean;
  return (from_mean - directions * (directions.transpose() * from_mean)).rowwise().squaredNorm() /
         static_cast<double>(held.cols());
}

TEST(WindowMoments, TellWhatDirectionsLeaveOfTheOtherHalf) {
  Random random(2);
  const MatrixXd mixing = random_matrix(random, 8, 8);
  const MatrixXd a = mixing * random_matrix(random, 8, 12),
                 b = mixing * random_matrix(random, 8, 9);
  WindowMoments half(8), other_half(8);
  half.add(a);
  other_half.add(b);
  const VectorXd expected = 0.5 * (left_by_projection(a, b, 3) + left_by_projection(b, a, 3));
  EXPECT_LT((cross_validated_rest(half, other_half, 3) - expected).norm(), 1e-9 * expected.norm());
}

TEST(TrainingHalves, AreEveryOtherTakeOrTheHalvesOfTheOnlyOne) {
  const auto halves_of = [](std::size_t take, std::size_t takes, std::size_t frames) {
    PoseMatrix poses(frames, 2);
    for (std::size_t i = 0; i < poses.values.size(); ++i) poses.values[i] = static_cast<double>(i);
    std::vector<std::vector<double>> found;
    for_each_half({poses, 1, take}, takes, 3, [&](std::size_t half, const PoseMatrix& part) {
      found.push_back(part.values);
      found.back().insert(found.back().begin(), static_cast<double>(half));
    });
    return found;
  };
  using Found = std::vector<std::vector<double>>;
  EXPECT_EQ(halves_of(0, 4, 2), (Found{{0, 0, 1, 2, 3}}));
  EXPECT_EQ(halves_of(3, 4, 2), (Found{{1, 0, 1, 2, 3}}));
  EXPECT_EQ(halves_of(0, 1, 6), (Found{{0, 0, 1, 2, 3, 4, 5}, {1, 6, 7, 8, 9, 10, 11}}));
  EXPECT_EQ(halves_of(0, 1, 2), (Found{{0, 0, 1, 2, 3}}));
}

}  // namespace
}  // namespace kinemend::test
