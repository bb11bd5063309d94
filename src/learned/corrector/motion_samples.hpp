// Samples that the network of motion learns from: of joints, and of their joints as markers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kinemend/experimental/random.hpp"
#include "learned/core/motion_forms.hpp"
#include "learned/core/training_sequences.hpp"
#include "learned/corrector/motion_steps.hpp"

namespace kinemend {

struct MotionSample {
  MotionTake take;
  std::vector<float> truth;  ///< F x C
  bool is_live = false;      ///< to be read frame by frame; no noise is measured
};

/// Of each channel of the body over the sequences: mean, deviation (at least 1 degree), and
/// deviation of its changes (degrees per 1/120 s, at least 0.02).
struct MotionStatistics {
  std::vector<float> mean, deviation, speed;
};
MotionStatistics motion_statistics(const TrainingSequences& sequences);

/// One motion by two systems on the same frames. Gains and offsets of channels are no noise: the
/// reference is mapped to the take by the affine map of each channel that fits best.
struct MotionPair {
  std::string name;
  MotionSample sample;
};
/// The same with the reference mapped, and channels that hardly move (deviation below `least_deg`)
/// made constant.
MotionPair mapped_pair(MotionPair pair, double least_deg);

/// Clean motion of markers, in the degrees that their body counts as (`MotionTracks`), each from
/// where it begins; the first is the root of the body.
struct MarkerMotion {
  double rate_hz = 120;
  PoseMatrix positions;  ///< F x 3 markers
};

/// A clean take of any rig: channels in the charts of `MotionTracks`, those of joints that the
/// model knows as of its body.
struct RigMotion {
  double rate_hz = 120;
  PoseMatrix values;                      ///< F x C degrees
  std::vector<std::int32_t> slots;        ///< C, as of `MotionTake`
  std::vector<std::uint8_t> is_position;  ///< C
};

/// What is learned from.
struct MotionSources {
  const TrainingSequences& sequences;
  const BodyMirror& mirror;
  std::span<const MotionPair> pairs{};
  std::span<const MarkerMotion> markers{};
  std::span<const RigMotion> rigs{};
};

struct MotionSampling {
  std::size_t steps = 128;     ///< of a sample
  double pair_share = 0.25;    ///< of samples that are pairs, where there are some
  double marker_share = 0.33;  ///< of the others that are of markers, where there are some
  double rig_share = 0.12;     ///< of the rest that are of other rigs, where there are some
  double clean_share = 0.33;   ///< of them that are clean
  double residual_share =
      0.2;                     ///< of damaged joints that get errors of pairs, where there are some
  double live_share = 0.2;     ///< of samples that are read live
  bool has_slow_noise = true;  ///< low-passed noise, and takes filtered after they were damaged
};

/// The same `random` gives the same sample. Its channels are those of the body of the sequences.
MotionSample random_motion_sample(const MotionSources& sources, const MotionSampling& sampling,
                                  Random random);

/// The channel is 0 throughout, which is to the network as if it were not there.
void stand_still(MotionSample& sample, std::size_t channel);

/// Each track but one with this chance.
void lose_whole_tracks(MotionSample& sample, double share, Random& random);

/// The errors of one system about a stretch of one take, turned over, scaled and played at another
/// pace, on all tracks at the same moments.
void add_residuals(PoseMatrix& poses, double rate_hz, std::span<const MotionPair> pairs,
                   Random& random);

/// F x tracks: what is seen of samples that are lost at random. Bridged by straight lines.
std::vector<std::uint8_t> lose_samples_at_random(PoseMatrix& values, double rate_hz,
                                                 Random& random);

/// The values, the truth and what is missing, as the first of so many channels, the others 0.
/// `observed`: F x tracks, or empty. Both are told from `origin` on, one a channel.
void put_values(MotionSample& sample, const PoseMatrix& seen, const PoseMatrix& truth,
                std::span<const double> origin, const std::vector<std::uint8_t>& observed,
                std::size_t channels);

/// A stretch of another rig's take, at its own rate or another, to and fro where it is short, with
/// some of its tracks; damaged in half of the samples. The same `random` gives the same sample.
MotionSample random_rig_sample(const MotionSources& sources, std::size_t channels,
                               const MotionSampling& sampling, Random random);

/// Of a sample at this rate.
std::size_t sample_frames(const MotionSampling& sampling, double rate_hz);

/// A stretch of the markers of a body that travels, or of what is left of its motion when it is
/// held where its root is; damaged as optical systems, video and depth cameras damage markers, and
/// as pipelines filter them. As many channels as asked for, the last of them 0. The same `random`
/// gives the same sample.
MotionSample random_marker_sample(std::span<const MarkerMotion> markers, std::size_t channels,
                                  const MotionSampling& sampling, Random random);

}  // namespace kinemend
