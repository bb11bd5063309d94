// Chooses the smoother of each axis by its likelihood and blends the result in. Estimates the
// covariance of each track's noise robustly.
#include "methods/auto/smoothing.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/signal.hpp"
#include "motion/rotation.hpp"
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

namespace {

// Candidates. The range of `SmoothingTuning::models`, in fewer steps for speed; not swept.
constexpr signal::CutoffGrid smoothing_cutoffs{0.003, 50, 24};

class ColouredSmoothing {
 public:
  ColouredSmoothing(VectorTracks& tracks, const SampleMarks& missing, const NoiseSpectrum& spectrum,
                    double scale, std::span<const double> shares, double frame_rate_hz,
                    const ColourTuning& tuning)
      : tracks_(tracks),
        missing_(missing),
        correlation_(spectrum.correlation),
        shares_(shares),
        frame_rate_hz_(frame_rate_hz),
        is_slow_(spectrum.is_slow),
        tuning_(tuning) {
    for (std::size_t n = 0; n < tracks.tracks(); ++n) {
      Vec3 deviations = scale * spectrum.deviations[n];
      for (std::size_t axis = 0; axis < 3 && shares[n] > 0; ++axis) {
        const double deviation = std::max(component_of(deviations, axis), least_noise);
        channels_.push_back(3 * n + axis);
        variance_.push_back(deviation * deviation);
      }
    }
    // Orders of differences, as of `signal::ModelGrid`; under slow noise only the smoothest.
    constexpr std::size_t all_orders[] = {1, 2, 3}, smooth_order[] = {3};
    candidates_ = signal::models_of_orders(is_slow_ ? std::span<const std::size_t>(smooth_order)
                                                    : std::span<const std::size_t>(all_orders),
                                           smoothing_cutoffs, tracks.frames(), frame_rate_hz);
  }

  void run(ShareProgress* progress) {
    if (candidates_.empty()) return;
    models_.resize(channels_.size());
    const std::size_t blocks =
        (channels_.size() + signal::block_channels - 1) / signal::block_channels;
    if (progress) progress->begin_part(0.65, blocks);
    for_each_parallel(blocks, channels_.size() * tracks_.frames() * candidates_.size(),
                      [&](std::size_t b) {
                        choose_models(b * signal::block_channels);
                        if (progress) progress->step();
                      });
    if (progress) progress->begin_part(0.75, models_.size() / signal::block_channels + 1);
    signal::for_each_of_one_order(models_, [&](const std::vector<std::size_t>& members) {
      smooth(members);
      if (progress) progress->step();
    });
  }

 private:
  static constexpr double least_noise = 1e-4;  // degrees, against division by zero

  std::span<Vec3> track(std::size_t i) { return tracks_.track(channels_[i] / 3); }

  void gather(std::span<const std::size_t> members, signal::ChannelBlock& y,
              signal::NoisePrecision& precision) {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t channel = channels_[members[k]];
      const std::span<Vec3> values = tracks_.track(channel / 3);
      for (std::size_t t = 0; t < values.size(); ++t)
        y(t, k) = component_of(values[t], channel % 3);
      precision.set_channel(k, correlation_, missing_.track(channel / 3));
    }
  }

  void choose_models(std::size_t first) {
    std::vector<std::size_t> members;
    for (std::size_t i = first; i < std::min(first + signal::block_channels, channels_.size()); ++i)
      members.push_back(i);
    signal::ChannelBlock y(tracks_.frames());
    signal::NoisePrecision precision(tracks_.frames());
    gather(members, y, precision);
    signal::BlockRow least;
    least.fill(std::numeric_limits<double>::infinity());
    for (const signal::SmoothingModel& model : candidates_) {
      const signal::ColouredEvidence evidence = signal::evidence_of(y, precision, model);
      for (std::size_t k = 0; k < members.size(); ++k) {
        const double variance = variance_[members[k]];
        const double misfit = evidence.squares[k] / variance + evidence.logarithms[k] +
                              evidence.differences[k] * portable::log(variance);
        if (!(misfit < least[k])) continue;
        least[k] = misfit;
        models_[members[k]] = model;
      }
    }
  }

  void smooth(const std::vector<std::size_t>& members) {
    const std::size_t frames = tracks_.frames();
    signal::ChannelBlock y(frames);
    signal::NoisePrecision precision(frames);
    gather(members, y, precision);
    std::vector<double> variance;
    std::vector<signal::SmoothingModel> models;
    for (std::size_t k = 0; k < members.size(); ++k) {
      variance.push_back(variance_[members[k]]);
      models.push_back(models_[members[k]]);
      for (std::size_t t = 0; t < frames; ++t) {
        precision.weight(t, k) /= variance[k];
        precision.coupling(t, k) /= variance[k];
      }
    }
    signal::AdaptiveSettings settings;
    settings.share_of_constant = tuning_.share_of_constant;
    if (is_slow_) settings.iterations = 0;
    signal::ChannelBlock x = signal::smooth_adaptively(
        y, precision.weight, variance, models, frame_rate_hz_, settings, &precision.coupling);
    if (is_slow_) remove_trembling(x);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t channel = channels_[members[k]];
      const double share = shares_[channel / 3];
      const std::span<Vec3> values = tracks_.track(channel / 3);
      for (std::size_t t = 0; t < frames; ++t)
        component_of(values[t], channel % 3) = y(t, k) + share * (x(t, k) - y(t, k));
    }
  }

  // Slow noise has a floor of fast noise that its model lacks. A Gaussian removes its remainder
  // above about 5 Hz.
  void remove_trembling(signal::ChannelBlock& x) const {
    PoseMatrix rows(x.frames, signal::block_channels);
    rows.values.swap(x.values);
    gaussian_filter(rows, tuning_.trembling_s * window_rate_hz(frame_rate_hz_));
    rows.values.swap(x.values);
  }

  VectorTracks& tracks_;
  const SampleMarks& missing_;
  double correlation_;
  std::span<const double> shares_;
  double frame_rate_hz_;
  bool is_slow_;
  const ColourTuning& tuning_;
  std::vector<std::size_t> channels_;  // track * 3 + axis, of smoothed tracks
  std::vector<double> variance_;       // of the noise on each of them
  std::vector<signal::SmoothingModel> candidates_, models_;
};

}  // namespace

void smooth_coloured(VectorTracks& tracks, const SampleMarks& missing,
                     const NoiseSpectrum& spectrum, double scale, std::span<const double> shares,
                     double frame_rate_hz, ShareProgress* progress, const ColourTuning& tuning) {
  if (tracks.frames() < 4) return;
  ColouredSmoothing(tracks, missing, spectrum, scale, shares, frame_rate_hz, tuning).run(progress);
}

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
