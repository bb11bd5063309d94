// Rotates tracks to the principal axes of their fast motion and smooths each axis by its likeliest
// model.
#include "methods/auto/track_smoother.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "motion/component.hpp"
#include "signal/evidence.hpp"

namespace kinemend {

namespace {

// Three moving averages of `half` frames on either side: a low-pass filter of about 2 Hz.
std::vector<Vec3> slow_motion(std::vector<Vec3> values, std::size_t half) {
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

// Columns are the principal axes of a track's fast motion: the signal along each, and thus the
// likeliest strength, differs.
Eigen::Matrix3d principal_axes(const std::vector<Vec3>& values, double half_frames) {
  if (values.size() < 8) return Eigen::Matrix3d::Identity();
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(half_frames)));
  const std::vector<Vec3> slow = slow_motion(values, half);
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

Vec3 lane_vector(const signal::ChannelBlock& block, std::size_t frame, std::size_t lane) {
  return {block(frame, 3 * lane), block(frame, 3 * lane + 1), block(frame, 3 * lane + 2)};
}

// Smooths some tracks in place, a block of channels at a time.
class Smoothing {
 public:
  Smoothing(VectorTracks& tracks, const SampleMarks& missing, std::span<const double> noise,
            std::vector<std::size_t> chosen, double frame_rate_hz, const SmoothingTuning& tuning)
      : tracks_(tracks),
        missing_(missing),
        chosen_(std::move(chosen)),
        frame_rate_hz_(frame_rate_hz),
        tuning_(tuning),
        grid_(tracks.frames(), frame_rate_hz, tuning.models),
        axes_(chosen_.size()),
        models_(3 * chosen_.size()) {
    for (const std::size_t track : chosen_) {
      const double deviation = std::max(noise[track], tuning.noise_floor);
      variance_.insert(variance_.end(), 3, deviation * deviation);
    }
  }

  void run(std::span<const double> shares, ShareProgress* progress) {
    if (grid_.models().empty()) return;
    // Tracks of three axes that fit a block of channels. By definition.
    constexpr std::size_t together = signal::block_channels / 3;
    const std::size_t blocks = (chosen_.size() + together - 1) / together;
    if (progress) progress->begin_part(0.55, blocks);
    for_each_parallel(blocks, samples(), [&](std::size_t b) {
      const std::size_t first = b * together;
      turn_to_axes(first, std::min(together, chosen_.size() - first));
      if (progress) progress->step();
    });
    if (progress) progress->begin_part(0.75, models_.size() / signal::block_channels + 1);
    signal::for_each_of_one_order(models_, [&](const std::vector<std::size_t>& channels) {
      smooth(channels, shares);
      if (progress) progress->step();
    });
    for_each_parallel(chosen_.size(), samples(), [&](std::size_t i) { turn_back(i); });
  }

 private:
  std::size_t samples() const { return chosen_.size() * tracks_.frames() * 3; }
  std::span<Vec3> track(std::size_t i) { return tracks_.track(chosen_[i]); }

  signal::ChannelBlock gather(std::size_t first, std::size_t count) {
    signal::ChannelBlock block(tracks_.frames());
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const Vec3> values = track(first + i);
      for (std::size_t t = 0; t < values.size(); ++t) {
        block(t, 3 * i) = values[t].x;
        block(t, 3 * i + 1) = values[t].y;
        block(t, 3 * i + 2) = values[t].z;
      }
    }
    return block;
  }

  // Rotates tracks to their principal axes and chooses the models of these.
  void turn_to_axes(std::size_t first, std::size_t count) {
    const auto variance = std::span(variance_).subspan(3 * first, 3 * count);
    {
      signal::ChannelBlock pilot = gather(first, count);
      signal::smooth_with(grid_, signal::most_likely_models(pilot, variance, grid_, 3), pilot);
      std::vector<Vec3> values(tracks_.frames());
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t t = 0; t < values.size(); ++t) values[t] = lane_vector(pilot, t, i);
        axes_[first + i] = principal_axes(values, tuning_.axes_window_s * frame_rate_hz_);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Matrix3d to_axes = axes_[first + i].transpose();
      for (Vec3& value : track(first + i)) value = turned(to_axes, value);
    }
    const auto found = signal::most_likely_models(gather(first, count), variance, grid_);
    for (std::size_t c = 0; c < found.size(); ++c)
      models_[3 * first + c] = grid_.models()[found[c]];
  }

  void smooth(const std::vector<std::size_t>& channels, std::span<const double> shares) {
    const std::size_t frames = tracks_.frames();
    signal::ChannelBlock y(frames), weight(frames, 1);
    std::vector<double> variance;
    std::vector<signal::SmoothingModel> models;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const std::size_t c = channels[k];
      const std::span<Vec3> values = track(c / 3);
      const auto missing = missing_.track(chosen_[c / 3]);
      variance.push_back(variance_[c]);
      models.push_back(models_[c]);
      for (std::size_t t = 0; t < frames; ++t) {
        y(t, k) = component_of(values[t], c % 3);
        weight(t, k) = missing[t] != 0 ? 0 : 1 / variance_[c];
      }
    }
    const signal::ChannelBlock x =
        signal::smooth_adaptively(y, weight, variance, models, frame_rate_hz_, tuning_.adaptive);
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const std::size_t c = channels[k];
      const double share = shares[chosen_[c / 3]];
      const std::span<Vec3> values = track(c / 3);
      for (std::size_t t = 0; t < frames; ++t)
        component_of(values[t], c % 3) = y(t, k) + share * (x(t, k) - y(t, k));
    }
  }

  void turn_back(std::size_t i) {
    for (Vec3& value : track(i)) value = turned(axes_[i], value);
  }

  VectorTracks& tracks_;
  const SampleMarks& missing_;
  std::vector<std::size_t> chosen_;
  double frame_rate_hz_;
  const SmoothingTuning& tuning_;
  signal::ModelGrid grid_;
  std::vector<double> variance_;  // of each channel: three per chosen track
  std::vector<Eigen::Matrix3d> axes_;
  std::vector<signal::SmoothingModel> models_;
};

}  // namespace

void smooth_tracks(VectorTracks& tracks, const SampleMarks& missing, std::span<const double> noise,
                   std::span<const double> shares, double frame_rate_hz, ShareProgress* progress,
                   const SmoothingTuning& tuning) {
  std::vector<std::size_t> chosen;
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    if (shares[n] > 0) chosen.push_back(n);
  }
  if (chosen.empty() || tracks.frames() < 4) return;
  Smoothing(tracks, missing, noise, std::move(chosen), frame_rate_hz, tuning).run(shares, progress);
}

}  // namespace kinemend
