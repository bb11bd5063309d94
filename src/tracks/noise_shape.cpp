#include "tracks/noise_shape.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace kinemend {

namespace {

// Below this the differences may well be motion, which has its own directions.
constexpr double least_level = 0.5;  // degrees at 120 Hz
// Logarithm of the largest over the least deviation, in an endless take and for chance in a short
// one.
constexpr double clear_ratio = 0.35, chance_ratio = 5;
constexpr double largest_ratio = 10;
constexpr std::size_t fewest_differences = 60, most_differences = 4000;
constexpr int rounds = 12;

// Tyler's M-estimator: only directions count, so that spikes and impacts weigh no more than any
// other sample.
Eigen::Matrix3d scatter_of(const std::vector<Vec3>& differences) {
  const std::size_t step = 1 + differences.size() / most_differences;
  const Eigen::Matrix3d least = Eigen::Matrix3d::Identity() / (largest_ratio * largest_ratio);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Identity();
  for (int round = 0; round < rounds; ++round) {
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

NoiseShape shape_of(const VectorTracks& tracks, const SampleMarks& missing, std::size_t track) {
  const std::vector<Vec3> differences =
      fifth_differences(tracks.track(track), missing.track(track));
  if (differences.size() < fewest_differences) return {};
  const Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter_of(differences)).eigenvectors();
  const auto axis = [&](Eigen::Index a) { return Vec3{axes(0, a), axes(1, a), axes(2, a)}; };
  const Vec3 levels = noise_along(differences, {axis(0), axis(1), axis(2)});
  Eigen::Vector3d deviations(levels.x, levels.y, levels.z);
  deviations = deviations.cwiseMax(deviations.maxCoeff() / largest_ratio);
  const double ratio = std::log(deviations.maxCoeff() / deviations.minCoeff());
  const double count = static_cast<double>(differences.size());
  if (!(ratio > clear_ratio + chance_ratio / std::sqrt(count))) return {};
  const double mean = std::sqrt(deviations.squaredNorm() / 3);
  return {false, (mean * deviations.cwiseInverse()).asDiagonal() * axes.transpose(),
          axes * (deviations / mean).asDiagonal()};
}

void map_tracks(VectorTracks& tracks, std::span<const NoiseShape> shapes,
                Eigen::Matrix3d NoiseShape::*map) {
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    if (shapes[n].is_round) return;
    const Eigen::Matrix3d matrix = shapes[n].*map;
    for (std::size_t t = 0; t < tracks.frames(); ++t) {
      const Vec3 v = tracks.at(t, n);
      const Eigen::Vector3d mapped = matrix * Eigen::Vector3d(v.x, v.y, v.z);
      tracks.set(t, n, {mapped.x(), mapped.y(), mapped.z()});
    }
  });
}

}  // namespace

std::vector<NoiseShape> noise_shapes(const VectorTracks& tracks, const SampleMarks& missing,
                                     double frame_rate_hz) {
  std::vector<NoiseShape> shapes(tracks.tracks());
  const std::vector<double> levels = noise_levels(tracks, missing);
  const double least = least_level * std::max(1.0, 120 / frame_rate_hz);
  for_each_parallel(shapes.size(), tracks.values.size(), [&](std::size_t n) {
    if (levels[n] >= least) shapes[n] = shape_of(tracks, missing, n);
  });
  return shapes;
}

void make_round(VectorTracks& tracks, std::span<const NoiseShape> shapes) {
  for (std::size_t n = 0; n < shapes.size(); ++n) tracks.has_quiet_axes[n] = !shapes[n].is_round;
  map_tracks(tracks, shapes, &NoiseShape::to_round);
}

void undo_round(VectorTracks& tracks, std::span<const NoiseShape> shapes) {
  std::fill(tracks.has_quiet_axes.begin(), tracks.has_quiet_axes.end(), std::uint8_t{0});
  map_tracks(tracks, shapes, &NoiseShape::from_round);
}

}  // namespace kinemend
