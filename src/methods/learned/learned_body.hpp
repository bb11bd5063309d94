// Converts the joints that the model of `learned` knows to channels of its body and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/representation.hpp"
#include "kinemend/take.hpp"
#include "methods/learned/body_calibration.hpp"
#include "methods/learned/motion_channels.hpp"
#include "methods/learned/motion_network.hpp"

namespace kinemend {

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
/// (docs/methods/learned.md).
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
