// Converts tracks of any take to channels of the learned cleaner and back: rotations as vectors
// about a smoothed reference, positions in body heights, both in degrees. Joints that the model
// knows become channels of its body, calibrated by the motion itself so that they are the same on
// every rig.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/take.hpp"
#include "methods/learned/motion_network.hpp"
#include "methods/learned/motion_steps.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

struct MotionTracks {
  std::vector<std::size_t> numbers;  ///< of the take's tracks; channels 3 n to 3 n + 2 are the n-th
  std::vector<std::optional<RotationChart>> charts;  ///< of tracks that turn
  std::vector<std::uint8_t> is_spike;                ///< F x tracks
  double degrees_per_unit = 0;                       ///< of positions
  std::vector<Vec3> origins;                         ///< of each track, subtracted from it
  MotionTake take;                                   ///< without channels of a known body
};

/// Spikes are bridged, and marked as missing.
MotionTracks motion_tracks_of(const TakeView& take, std::vector<std::size_t> numbers);
/// Samples of another take for the same tracks in the same charts and units: F x C.
std::vector<float> values_in(const MotionTracks& tracks, const TakeView& other);
/// The n-th track from `values` (F x C). Unseen marker samples are unchanged.
CleanedTrack cleaned_track(const MotionTracks& tracks, const TakeView& take, std::size_t n,
                           std::span<const float> values);

/// A rig's bone axes and rest pose turn the frame of each joint by a constant rotation. Let G_j be
/// the rotation of joint j in the body's frame, the product of the rotations q along its ancestors,
/// and M_j the same product of the layout's references. With the turns
///
///   K_j = mean(G_j)^-1 M_j,    q'_j = K_p^-1 q_j K_j    (p the parent; the root has no K_p)
///
/// every joint has the reference as its mean pose, and q' no longer depends on such constants: on
/// another rig G_j is G_j A_j, mean(G_j) is mean(G_j) A_j, and G_j K_j is unchanged.
struct BodyCalibration {
  std::vector<Quat> turns;  ///< N: K
};

/// `poses`: F x D channels of the layout's joints, degrees; at least one frame. The mean is that of
/// quaternions, each with the sign that is nearer to the sum so far.
BodyCalibration calibration_of(const PoseMatrix& poses, const BodyLayout& layout);
/// Converts the channels of q to those of q'; channels of the place are unchanged. `rate_hz` is the
/// frame rate.
PoseMatrix calibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                      const BodyCalibration& calibration);
/// Converts the channels of q' to those of q.
PoseMatrix uncalibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                        const BodyCalibration& calibration);

/// Limits of the training data. Chosen by hand, like the training.
inline constexpr double shortest_learned_take_s = 0.5, lowest_learned_rate_hz = 20;

/// Why the method does not change a take; empty if it does.
std::string why_not_learned(const TakeView& view);

struct KnownBody {
  BodyMatch match;
  Take clip;              ///< without spikes
  BodyChannels channels;  ///< calibrated
  BodyCalibration calibration;
  std::vector<std::int32_t> track_of;  ///< N and the place: index in `MotionTracks`, or -1
};

/// The widest motion of a known body: the median over its joints of the root mean square turn about
/// the mean pose, in deviations of the training. Takes of CMU have 0.4 to 1.45, those above this
/// limit are dances; a clean take of boxing has 1.5, gestures of single arms up to 3
/// (docs/details/learned.md).
inline constexpr double most_spread = 1.3;

/// The joints of a take, read as the model's body.
struct BodyReading {
  std::optional<KnownBody> body;  ///< none if the model knows too little of the take
  double spread = 0;              ///< as of `most_spread`; 0 if no joints were found by name
};

/// Matches joints by name and calibrates their frames (`BodyCalibration`), so that the same motion
/// is the same on every rig. Joints that their channels cannot describe are left out, and so is a
/// body that moves unlike the training. `deviation`: of each channel of the layout, degrees.
BodyReading read_body(const BodyLayout& layout, std::span<const float> deviation,
                      const NameMap& names, const TakeView& view, const MotionTracks& tracks);
/// One per track, 1 if the model knows its joint.
std::vector<std::uint8_t> marks_of(const std::optional<KnownBody>& body, std::size_t tracks);
/// Replaces the channels of known joints by those of the body.
void show_body(const KnownBody& body, MotionTake& take);
/// Writes `values` (F x C of the take with `show_body`) to the body's channels and its clip.
void decode_known_body(KnownBody& body, const BodyLayout& layout, const MotionTake& take,
                       std::span<const float> values);

}  // namespace kinemend
