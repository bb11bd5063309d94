// Tests of singular spectrum analysis, against the whole trajectory matrix and a full solver.
#include "papers/lou2010_example/filter_bases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "dense_algebra.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

// Smooth channels that move together, each with an offset.
PoseMatrix waves(std::size_t frames, std::size_t channels, std::uint64_t seed) {
  Random random(seed);
  PoseMatrix poses(frames, channels);
  for (std::size_t wave = 0; wave < 4; ++wave) {
    const double speed = 0.05 + 0.2 * random.uniform();
    for (std::size_t c = 0; c < channels; ++c) {
      const double size = random.normal(), phase = 6.28 * random.uniform();
      for (std::size_t f = 0; f < frames; ++f) {
        poses(f, c) += size * std::sin(speed * static_cast<double>(f) + phase);
      }
    }
  }
  for (std::size_t c = 0; c < channels; ++c) {
    const double offset = 5 * random.normal();
    for (std::size_t f = 0; f < frames; ++f) poses(f, c) += offset + 0.1 * random.normal();
  }
  return poses;
}

struct Weighted {
  PoseMatrix poses;
  double weight;
};

Eigen::VectorXd frame_mean(const std::vector<Weighted>& sequences) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(sequences[0].poses.channels);
  double count = 0;
  for (const auto& [poses, weight] : sequences) {
    for (std::size_t f = 0; f < poses.frames; ++f) {
      for (std::size_t c = 0; c < poses.channels; ++c) sum[c] += weight * poses(f, c);
    }
    count += weight * static_cast<double>(poses.frames);
  }
  return sum / count;
}

// Eq. 1-3 with an explicit trajectory matrix of all sequences.
Eigen::MatrixXd brute_covariance(const std::vector<Weighted>& sequences, std::size_t window,
                                 const Eigen::VectorXd& mean) {
  const std::size_t L = sequences[0].poses.channels;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(window * L, window * L);
  double count = 0;
  for (const auto& [poses, weight] : sequences) {
    for (std::size_t n = 0; n + window <= poses.frames; ++n) {
      Eigen::VectorXd row(window * L);
      for (std::size_t j = 0; j < window; ++j) {
        for (std::size_t l = 0; l < L; ++l) row[j * L + l] = poses(n + j, l) - mean[l];
      }
      sum += weight * row * row.transpose();
      count += weight;
    }
  }
  return sum / count;
}

Eigen::MatrixXd as_matrix(const std::vector<double>& values, std::size_t rows,
                          std::size_t columns) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

std::vector<Weighted> several_sequences() {
  return {{waves(60, 5, 1), 1.0},
          {waves(13, 5, 2), 0.25},
          {waves(12, 5, 3), 2.0},
          {waves(200, 5, 4), 0.5}};
}

TEST(LagCovariance, IsThatOfTheWholeTrajectoryMatrix) {
  const auto sequences = several_sequences();
  LagCovariance covariance(12, 5);
  for (const auto& [poses, weight] : sequences) covariance.add(poses, weight);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(5);
  const Eigen::MatrixXd raw = as_matrix(covariance.covariance(false), 60, 60);
  const Eigen::MatrixXd centred = as_matrix(covariance.covariance(true), 60, 60);
  EXPECT_LT((raw - brute_covariance(sequences, 12, zero)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(
      (centred - brute_covariance(sequences, 12, frame_mean(sequences))).cwiseAbs().maxCoeff(),
      1e-12);
  EXPECT_EQ(centred, centred.transpose());
  EXPECT_DOUBLE_EQ(covariance.windows(), 49 + 0.25 * 2 + 2 + 0.5 * 189);
  const Eigen::VectorXd mean = frame_mean(sequences);
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(covariance.mean()[c], mean[c], 1e-12);
}

TEST(LagCovariance, IsTheSameForManySequencesThatAreAddedInBatches) {
  std::vector<Weighted> sequences;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    sequences.push_back({waves(20 + seed % 7, 3, seed), 1.0 / static_cast<double>(1 + seed % 3)});
  }
  LagCovariance covariance(20, 3);
  for (const auto& [poses, weight] : sequences) covariance.add(poses, weight);
  const Eigen::MatrixXd found = as_matrix(covariance.covariance(), 60, 60);
  EXPECT_LT((found - brute_covariance(sequences, 20, frame_mean(sequences))).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST(LagCovariance, OfWindowsOfOneFrameIsThatOfTheChannels) {
  const std::vector<Weighted> sequences = {{waves(30, 4, 1), 1.0}};
  LagCovariance covariance(1, 4);
  covariance.add(sequences[0].poses);
  const Eigen::MatrixXd found = as_matrix(covariance.covariance(), 4, 4);
  EXPECT_LT((found - brute_covariance(sequences, 1, frame_mean(sequences))).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST(LagCovariance, LeavesOutWhatIsShorterThanAWindow) {
  LagCovariance covariance(20, 4);
  covariance.add(waves(19, 4, 1));
  EXPECT_EQ(covariance.windows(), 0);
  EXPECT_THROW(filter_bases(covariance), Error);
}

TEST(FilterBases, AreTheLeadingEigenvectorsOfAFullSolver) {
  const auto sequences = several_sequences();
  LagCovariance covariance(12, 5);
  for (const auto& [poses, weight] : sequences) covariance.add(poses, weight);
  const test::SymmetricEigen full =
      test::symmetric_eigen(brute_covariance(sequences, 12, frame_mean(sequences)));
  const FilterBases found = filter_bases(covariance, {.energy = 0.99});
  double sum = 0;
  for (std::size_t k = 0; k < found.count; ++k) {
    const Eigen::Index from_end = 59 - static_cast<Eigen::Index>(k);
    EXPECT_NEAR(found.eigenvalues[k], full.values[from_end], 1e-10);
    const Eigen::VectorXd expected = full.vectors.col(from_end);
    EXPECT_NEAR(std::abs(as_matrix(found.bases, 60, found.count).col(k).dot(expected)), 1, 1e-9);
    EXPECT_LT(sum, 0.99 * full.values.sum()) << "fewer would have been enough";
    sum += found.eigenvalues[k];
  }
  EXPECT_GE(sum, 0.99 * full.values.sum());
  EXPECT_NEAR(found.total_energy, full.values.sum(), 1e-9);
}

TEST(FilterBases, SayWhatTheyLeaveOfEachChannel) {
  const std::vector<Weighted> sequences = {{waves(150, 6, 1), 1.0}};
  LagCovariance covariance(10, 6);
  covariance.add(sequences[0].poses);
  const FilterBases found = filter_bases(covariance, {.count = 4});
  ASSERT_EQ(found.count, 4u);
  const Eigen::MatrixXd E = as_matrix(found.bases, 60, 4);
  const Eigen::MatrixXd C = brute_covariance(sequences, 10, frame_mean(sequences));
  const Eigen::MatrixXd outside = Eigen::MatrixXd::Identity(60, 60) - E * E.transpose();
  const Eigen::VectorXd left = (outside * C * outside).diagonal();
  for (std::size_t l = 0; l < 6; ++l) {
    double mean = 0;
    for (std::size_t j = 0; j < 10; ++j) mean += left[j * 6 + l] / 10;
    EXPECT_NEAR(found.residual[l], mean, 1e-9);
  }
}

TEST(CrossValidation, HoldsEachHalfsBasesAgainstTheOtherHalf) {
  const std::vector<Weighted> first = {{waves(150, 4, 1), 1.0}}, second = {{waves(90, 4, 2), 1.0}};
  LagCovariance both(8, 4), half(8, 4), other(8, 4);
  both.add(first[0].poses), both.add(second[0].poses);
  half.add(first[0].poses);
  other.add(second[0].poses);
  FilterBases bases = filter_bases(both, {.count = 5});
  cross_validate(bases, half, other);

  Eigen::VectorXd along = Eigen::VectorXd::Zero(5), outside = Eigen::VectorXd::Zero(4);
  const auto hold = [&](const std::vector<Weighted>& learned, const std::vector<Weighted>& held) {
    const Eigen::VectorXd mean = frame_mean(learned);
    const test::SymmetricEigen full = test::symmetric_eigen(brute_covariance(learned, 8, mean));
    const Eigen::MatrixXd E = full.vectors.rightCols(5).rowwise().reverse();
    const Eigen::MatrixXd C = brute_covariance(held, 8, mean);
    along += (E.transpose() * C * E).diagonal() / 2;
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(32, 32) - E * E.transpose();
    const Eigen::VectorXd left = (rest * C * rest).diagonal();
    for (int i = 0; i < 32; ++i) outside[i % 4] += left[i] / 16;
  };
  hold(first, second);
  hold(second, first);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(bases.eigenvalues[k], along[k], 1e-8);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(bases.residual[c], outside[c], 1e-8);
}

}  // namespace
}  // namespace kinemend
