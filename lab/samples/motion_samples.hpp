// Training samples of the motion network: of joints, and of their joints as markers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "lab/samples/motion_forms.hpp"
#include "lab/training/training_sequences.hpp"
#include "methods/learned/motion_steps.hpp"

namespace kinemend {

struct MotionSample {
  MotionTake take;
  std::vector<float> truth;  ///< F x C
  bool is_live = false;      ///< read frame by frame, without measured noise
};

/// For each channel of the body over the sequences: mean, deviation (at least 1 degree), and
/// deviation of its changes (degrees per 1/120 s, at least 0.02).
struct MotionStatistics {
  std::vector<float> mean, deviation, speed;
};
MotionStatistics motion_statistics(const TrainingSequences& sequences);

/// One motion from two systems on the same frames. Gains and offsets of channels are not noise: the
/// reference is mapped to the take by the affine map of each channel that fits best.
struct MotionPair {
  std::string name;
  MotionSample sample;
};
/// Maps the reference of the pair, and makes channels that hardly move (deviation below
/// `least_deg`) constant.
MotionPair mapped_pair(MotionPair pair, double least_deg);

/// Clean motion of markers, in the degrees of `MotionTracks`, each relative to its first position;
/// the first marker is the root of the body.
struct MarkerMotion {
  double rate_hz = 120;
  PoseMatrix positions;  ///< F x 3 markers
};

/// A clean take of any rig: channels in the charts of `MotionTracks`; joints that the model knows
/// are in the channels of its body.
struct RigMotion {
  double rate_hz = 120;
  PoseMatrix values;                      ///< F x C degrees
  std::vector<std::int32_t> slots;        ///< C, as of `MotionTake`
  std::vector<std::uint8_t> is_position;  ///< C
};

/// The data of the training.
struct MotionSources {
  const TrainingSequences& sequences;
  const BodyMirror& mirror;
  std::span<const MotionPair> pairs{};
  std::span<const MarkerMotion> markers{};
  std::span<const RigMotion> rigs{};
};

struct MotionSampling {
  std::size_t steps = 128;      ///< of a sample
  double pair_share = 0.25;     ///< share of pairs, if any
  double marker_share = 0.33;   ///< share of marker samples in the others, if any
  double rig_share = 0.12;      ///< share of other rigs in the rest, if any
  double clean_share = 0.33;    ///< share of clean samples in them
  double residual_share = 0.2;  ///< share of damaged joints with errors of pairs, if any
  double live_share = 0.2;      ///< share of samples that are read live
  bool has_slow_noise = true;   ///< low-passed noise, and takes filtered after they were damaged
};

/// A random sample with the channels of the sequences' body. The same `random` gives the same
/// sample.
MotionSample random_motion_sample(const MotionSources& sources, const MotionSampling& sampling,
                                  Random random);

/// Sets the channel to 0 throughout, which the network treats as absent.
void stand_still(MotionSample& sample, std::size_t channel);

/// Clears each track but one with this chance.
void lose_whole_tracks(MotionSample& sample, double share, Random& random);

/// Adds the errors of one system over a stretch of one take to all tracks at the same frames, with
/// random signs, scale and pace.
void add_residuals(PoseMatrix& poses, double rate_hz, std::span<const MotionPair> pairs,
                   Random& random);

/// Loses samples at random and bridges them by straight lines. Returns F x tracks: 1 where
/// observed.
std::vector<std::uint8_t> lose_samples_at_random(PoseMatrix& values, double rate_hz,
                                                 Random& random);

/// Writes the values, the truth and the missing marks to the first of `channels` channels, the
/// others 0. `observed`: F x tracks, or empty. Both are relative to `origin`, one per channel.
void put_values(MotionSample& sample, const PoseMatrix& seen, const PoseMatrix& truth,
                std::span<const double> origin, const std::vector<std::uint8_t>& observed,
                std::size_t channels);

/// A stretch of another rig's take, at its own rate or another, played forwards and backwards if it
/// is short, with some of its tracks; damaged in half of the samples. The same `random` gives the
/// same sample.
MotionSample random_rig_sample(const MotionSources& sources, std::size_t channels,
                               const MotionSampling& sampling, Random random);

/// Frames of a sample at this rate.
std::size_t sample_frames(const MotionSampling& sampling, double rate_hz);

/// A stretch of the markers of a travelling body, or of its motion relative to the root; damaged
/// like markers of optical systems, video and depth cameras, and filtered as in pipelines. Unused
/// channels, the last of `channels`, are 0. The same `random` gives the same sample.
MotionSample random_marker_sample(std::span<const MarkerMotion> markers, std::size_t channels,
                                  const MotionSampling& sampling, Random random);

}  // namespace kinemend
