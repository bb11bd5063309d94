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

/// Matches joints by name and calibrates their frames (`BodyCalibration`), so that the same motion
/// is the same on every rig. Joints whose channels cannot say what they do are left out. Nothing
/// where the model knows too little of the take.
std::optional<KnownBody> read_body(const BodyLayout& layout, const NameMap& names,
                                   const TakeView& view, const MotionTracks& tracks);
/// One a track, 1 where the model knows its joint.
std::vector<std::uint8_t> marks_of(const std::optional<KnownBody>& body, std::size_t tracks);
/// Channels of the body take the place of those that know nothing of it.
void show_body(const KnownBody& body, MotionTake& take);
/// Writes what `values` (F x C of the take that was shown the body) say into the body's channels
/// and its clip.
void decode_known_body(KnownBody& body, const BodyLayout& layout, const MotionTake& take,
                       std::span<const float> values);

}  // namespace kinemend
