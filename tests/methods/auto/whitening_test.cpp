// Tests of whitening, on noise of known covariance.
#include "methods/auto/smoothing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

// A slow sway with noise of these deviations along the columns of `axes`, degrees at 120 Hz.
VectorTracks noisy_track(std::size_t frames, const Eigen::Vector3d& deviations,
                         const Eigen::Matrix3d& axes, std::uint64_t seed) {
  Random random(seed);
  VectorTracks tracks(frames, 1);
  for (std::size_t t = 0; t < frames; ++t) {
    const double sway = 20 * std::sin(0.03 * static_cast<double>(t));
    const Eigen::Vector3d normal(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d v =
        axes * deviations.cwiseProduct(normal) + Eigen::Vector3d(sway, 0.5 * sway, 3);
    tracks.set(t, 0, {v.x(), v.y(), v.z()});
  }
  return tracks;
}

const Eigen::Matrix3d oblique =
    Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();

Whitening whitening_of(const VectorTracks& tracks) {
  return estimate_whitening(tracks, SampleMarks(tracks.frames(), 1), 120)[0];
}

TEST(Whitening, IsTheIdentityForIsotropicNoise) {
  for (const std::size_t frames : {80, 150, 400, 3000, 12000}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      EXPECT_TRUE(whitening_of(noisy_track(frames, {2, 2, 2}, oblique, seed)).is_identity)
          << frames << " frames, seed " << seed;
  }
}

TEST(Whitening, FindsTheNoiseCovariance) {
  const Eigen::Vector3d deviations(6, 2, 1);
  const Eigen::Matrix3d covariance =
      oblique * deviations.cwiseAbs2().asDiagonal() * oblique.transpose();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Whitening whitening = whitening_of(noisy_track(2000, deviations, oblique, seed));
    ASSERT_FALSE(whitening.is_identity);
    const Eigen::Matrix3d found = whitening.inverse * whitening.inverse.transpose();
    const Eigen::Matrix3d expected = 3 / covariance.trace() * covariance;
    EXPECT_LT((found - expected).norm(), 0.15 * expected.norm()) << "seed " << seed;
    EXPECT_LT((whitening.matrix * whitening.inverse - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(Whitening, DoesNotRespondToSpikes) {
  VectorTracks tracks = noisy_track(2000, {3, 3, 3}, oblique, 1);
  for (std::size_t t = 10; t < 2000; t += 100) tracks.set(t, 0, tracks.at(t, 0) + Vec3{200, 0, 0});
  EXPECT_TRUE(whitening_of(tracks).is_identity);
}

TEST(Whitening, IsTheIdentityForSmallNoiseAndShortTakes) {
  EXPECT_TRUE(whitening_of(noisy_track(2000, {0.5, 0.1, 0.1}, oblique, 1)).is_identity);
  EXPECT_TRUE(whitening_of(noisy_track(50, {6, 2, 1}, oblique, 1)).is_identity);
}

TEST(Whitening, GivesAllAxesOneNoiseAndIsUndone) {
  const VectorTracks before = noisy_track(1500, {6, 2, 0}, oblique, 3);
  const SampleMarks none(1500, 1);
  VectorTracks tracks = before;
  const auto whitenings = estimate_whitening(tracks, none, 120);
  whiten(tracks, whitenings);
  const Vec3 levels = noise_along(fifth_differences(tracks.track(0), none.track(0)),
                                  {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  // The axes are sorted by deviation; the first has none.
  EXPECT_LT(levels.x, 0.1 * levels.z);
  EXPECT_NEAR(levels.y, levels.z, 0.01 * levels.z);
  EXPECT_NEAR(noise_levels(tracks, none)[0], std::sqrt(40.0 / 3), 0.3);
  undo_whitening(tracks, whitenings);
  for (std::size_t t = 0; t < before.frames(); ++t)
    EXPECT_LT(norm(tracks.at(t, 0) - before.at(t, 0)), 1e-10);
  EXPECT_EQ(tracks.is_whitened[0], 0);
}

}  // namespace
}  // namespace kinemend
