// Estimates the covariance of each track's noise robustly and applies the maps.
#include "methods/auto/whitening.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/portable.hpp"

namespace kinemend {

namespace {

// Tyler's M-estimator. It uses directions only, so that spikes and impacts have the weight of any
// other sample.
Eigen::Matrix3d scatter_of(const std::vector<Vec3>& differences, const NoiseTuning& tuning) {
  const std::size_t step = 1 + differences.size() / tuning.most_differences;
  const Eigen::Matrix3d least =
      Eigen::Matrix3d::Identity() / (tuning.largest_ratio * tuning.largest_ratio);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Identity();
  for (int round = 0; round < tuning.rounds; ++round) {
    const Eigen::Matrix3d inverse = scatter.inverse();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < differences.size(); i += step) {
      const Eigen::Vector3d d(differences[i].x, differences[i].y, differences[i].z);
      const double distance = d.dot(inverse * d);
      if (distance > 0) sum += d * d.transpose() / distance;
    }
    const double trace = sum.trace();
    if (!(trace > 0)) return Eigen::Matrix3d::Identity();
    scatter = 3 / trace * sum + least;
  }
  return scatter;
}

Whitening whitening_of(const VectorTracks& tracks, const SampleMarks& missing, std::size_t track,
                       const NoiseTuning& tuning) {
  const std::vector<Vec3> differences =
      fifth_differences(tracks.track(track), missing.track(track));
  if (differences.size() < tuning.fewest_differences) return {};
  const Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter_of(differences, tuning))
          .eigenvectors();
  const auto axis = [&](Eigen::Index a) { return Vec3{axes(0, a), axes(1, a), axes(2, a)}; };
  const Vec3 levels = noise_along(differences, {axis(0), axis(1), axis(2)});
  Eigen::Vector3d deviations(levels.x, levels.y, levels.z);
  deviations = deviations.cwiseMax(deviations.maxCoeff() / tuning.largest_ratio);
  const double ratio = portable::log(deviations.maxCoeff() / deviations.minCoeff());
  const double count = static_cast<double>(differences.size());
  if (!(ratio > tuning.log_ratio + tuning.chance_log_ratio / std::sqrt(count))) return {};
  const double mean = std::sqrt(deviations.squaredNorm() / 3);
  return {false, (mean * deviations.cwiseInverse()).asDiagonal() * axes.transpose(),
          axes * (deviations / mean).asDiagonal()};
}

void map_track(std::span<Vec3> track, const Eigen::Matrix3d& matrix) {
  for (Vec3& v : track) {
    const Eigen::Vector3d mapped = matrix * Eigen::Vector3d(v.x, v.y, v.z);
    v = {mapped.x(), mapped.y(), mapped.z()};
  }
}

void map_tracks(VectorTracks& tracks, std::span<const Whitening> whitenings,
                Eigen::Matrix3d Whitening::*map) {
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    if (!whitenings[n].is_identity) map_track(tracks.track(n), whitenings[n].*map);
  });
}

}  // namespace

std::vector<Whitening> estimate_whitening(const VectorTracks& tracks, const SampleMarks& missing,
                                          double frame_rate_hz, const NoiseTuning& tuning) {
  std::vector<Whitening> whitenings(tracks.tracks());
  const std::vector<double> levels = noise_levels(tracks, missing, tuning);
  const double least = tuning.least_level * std::max(1.0, 120 / frame_rate_hz);
  for_each_parallel(whitenings.size(), tracks.values.size(), [&](std::size_t n) {
    if (levels[n] >= least) whitenings[n] = whitening_of(tracks, missing, n, tuning);
  });
  return whitenings;
}

void whiten(VectorTracks& tracks, std::span<const Whitening> whitenings) {
  for (std::size_t n = 0; n < whitenings.size(); ++n)
    tracks.is_whitened[n] = !whitenings[n].is_identity;
  map_tracks(tracks, whitenings, &Whitening::matrix);
}

void undo_whitening(VectorTracks& tracks, std::span<const Whitening> whitenings) {
  std::fill(tracks.is_whitened.begin(), tracks.is_whitened.end(), std::uint8_t{0});
  map_tracks(tracks, whitenings, &Whitening::inverse);
}

void undo_whitening(std::span<Vec3> track, const Whitening& whitening) {
  if (!whitening.is_identity) map_track(track, whitening.inverse);
}

}  // namespace kinemend
