#include "clean/track_smoother.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "clean/tracks.hpp"
#include "signal/evidence.hpp"

namespace kinemend {

namespace {

constexpr double least_noise = 1e-4;  // degrees

// Three moving averages of +-0.1 s after each other pass what is slower than about 2 Hz.
std::vector<Vec3> slow_part(std::vector<Vec3> values, std::size_t half) {
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  const auto reach = static_cast<std::ptrdiff_t>(half);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<Vec3> in = values;
    const auto at = [&](std::ptrdiff_t t) {
      return in[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(t, 0, last))];
    };
    Vec3 sum;
    for (std::ptrdiff_t t = -reach; t <= reach; ++t) sum += at(t);
    for (std::ptrdiff_t t = 0; t <= last; ++t) {
      values[static_cast<std::size_t>(t)] = (1.0 / static_cast<double>(2 * half + 1)) * sum;
      sum += at(t + reach + 1) - at(t - reach);
    }
  }
  return values;
}

// Columns are the principal axes of the fast part of a track's motion: along each of them the
// signal, and so the right strength, is a different one.
Eigen::Matrix3d principal_axes(const VectorTracks& tracks, std::size_t track,
                               double frame_rate_hz) {
  if (tracks.frames() < 8) return Eigen::Matrix3d::Identity();
  std::vector<Vec3> values(tracks.frames());
  for (std::size_t t = 0; t < values.size(); ++t) values[t] = tracks.at(t, track);
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(0.1 * frame_rate_hz)));
  const std::vector<Vec3> slow = slow_part(values, half);
  Eigen::Matrix3d moment = 1e-9 * Eigen::Matrix3d::Identity();
  for (std::size_t t = 0; t < values.size(); ++t) {
    const Vec3 fast = values[t] - slow[t];
    const Eigen::Vector3d v(fast.x, fast.y, fast.z);
    moment += v * v.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvectors();
}

Vec3 turned(const Eigen::Matrix3d& axes, Vec3 v) {
  const Eigen::Vector3d result = axes * Eigen::Vector3d(v.x, v.y, v.z);
  return {result.x(), result.y(), result.z()};
}

}  // namespace

void smooth_tracks(VectorTracks& tracks, const SampleMarks& missing, std::span<const double> noise,
                   std::span<const double> shares, double frame_rate_hz) {
  const std::size_t frames = tracks.frames();
  std::vector<std::size_t> chosen;
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    if (shares[n] > 0) chosen.push_back(n);
  }
  if (chosen.empty() || frames < 4) return;

  VectorTracks work(frames, chosen.size());
  std::vector<std::uint8_t> lost(work.values.values.size());
  std::vector<double> variance(work.values.channels);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double deviation = std::max(noise[chosen[i]], least_noise);
    for (std::size_t axis = 0; axis < 3; ++axis) variance[3 * i + axis] = deviation * deviation;
    for (std::size_t t = 0; t < frames; ++t) {
      work.set(t, i, tracks.at(t, chosen[i]));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lost[t * work.values.channels + 3 * i + axis] = missing(t, chosen[i]);
      }
    }
  }

  const signal::ModelGrid grid(frames, frame_rate_hz);
  VectorTracks pilot = work;
  signal::smooth_by_evidence(pilot.values, variance, grid, 3);
  std::vector<Eigen::Matrix3d> axes(chosen.size());
  for_each_parallel(chosen.size(), work.values.values.size(), [&](std::size_t i) {
    axes[i] = principal_axes(pilot, i, frame_rate_hz);
    const Eigen::Matrix3d to_axes = axes[i].transpose();
    for (std::size_t t = 0; t < frames; ++t) work.set(t, i, turned(to_axes, work.at(t, i)));
  });

  PoseMatrix by_evidence = work.values;
  const std::vector<std::size_t> found = signal::smooth_by_evidence(by_evidence, variance, grid);
  if (found.empty()) return;
  std::vector<signal::SmoothingModel> models;
  models.reserve(found.size());
  for (const std::size_t m : found) models.push_back(grid.models()[m]);
  signal::smooth_adaptively(work.values, lost, variance, models, frame_rate_hz);

  for_each_parallel(chosen.size(), work.values.values.size(), [&](std::size_t i) {
    const std::size_t n = chosen[i];
    for (std::size_t t = 0; t < frames; ++t) {
      const Vec3 before = tracks.at(t, n);
      tracks.set(t, n, before + shares[n] * (turned(axes[i], work.at(t, i)) - before));
    }
  });
}

}  // namespace kinemend
