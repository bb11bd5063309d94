// The joints of a take that the model of `learned` knows, as channels of its body, and back.
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
#include "learned/corrector/body_calibration.hpp"
#include "learned/corrector/motion_channels.hpp"
#include "learned/corrector/motion_network.hpp"

namespace kinemend {

/// Of what the network has learned from. Chosen by hand, as its training was.
inline constexpr double shortest_learned_take_s = 0.5, lowest_learned_rate_hz = 20;

/// Why the method has no say in a take; empty: it has one.
std::string why_not_learned(const TakeView& view);

struct KnownBody {
  BodyMatch match;
  Take clip;              ///< without spikes
  BodyChannels channels;  ///< calibrated
  BodyCalibration calibration;
  std::vector<std::int32_t> track_of;  ///< N and the place: the track among those cleaned, or -1
};

/// How widely a body may move: the root mean square turn of a joint about its mean pose, in
/// deviations of what the network has learned, of the middle one of its joints. Takes of CMU have
/// 0.4 to 1.45, those above this limit are dances; a clean take of boxing has 1.5, gestures of
/// single arms up to 3 (docs/methods/learned.md).
inline constexpr double most_spread = 1.3;

/// The joints of a take as the model sees them.
struct BodyReading {
  std::optional<KnownBody> body;  ///< nothing where the model knows too little of the take
  double spread = 0;              ///< see above; 0 where no joints were found by name
};

/// Matches joints by name and calibrates their frames (`BodyCalibration`), so that the same motion
/// is the same on every rig. Joints whose channels cannot say what they do are left out, and so is
/// a body that moves unlike what the network has learned from. `deviation`: of each channel of the
/// layout, degrees.
BodyReading read_body(const BodyLayout& layout, std::span<const float> deviation,
                      const NameMap& names, const TakeView& view, const MotionTracks& tracks);
/// One a track, 1 where the model knows its joint.
std::vector<std::uint8_t> marks_of(const std::optional<KnownBody>& body, std::size_t tracks);
/// Channels of the body take the place of those that know nothing of it.
void show_body(const KnownBody& body, MotionTake& take);
/// Writes what `values` (F x C of the take that was shown the body) say into the body's channels
/// and its clip.
void decode_known_body(KnownBody& body, const BodyLayout& layout, const MotionTake& take,
                       std::span<const float> values);

}  // namespace kinemend
