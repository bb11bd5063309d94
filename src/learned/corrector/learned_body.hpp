// The joints of a take that the model of `learned` knows, as channels of its body, and back.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/representation.hpp"
#include "kinemend/take.hpp"
#include "learned/corrector/motion_channels.hpp"

namespace kinemend {

/// Of what the network has learned from. Chosen by hand, as its training was.
inline constexpr double shortest_learned_take_s = 0.5, lowest_learned_rate_hz = 20;

/// Why the method has no say in a take; empty: it has one.
std::string why_not_learned(const TakeView& view);

struct KnownBody {
  BodyMatch match;
  Take clip;  ///< without spikes
  BodyChannels channels;
  std::vector<std::int32_t> track_of;  ///< N and the place: the track among those cleaned, or -1
};

/// Nothing where the model knows too little of the take.
std::optional<KnownBody> known_body(const BodyLayout& layout, const NameMap& names,
                                    const TakeView& view, const MotionTracks& tracks);
/// Channels of the body take the place of those that know nothing of it.
void show_body(const KnownBody& body, MotionTake& take);
/// Writes what `values` (F x C of the take that was shown the body) say into the body's channels
/// and its clip.
void decode_known_body(KnownBody& body, const BodyLayout& layout, const MotionTake& take,
                       std::span<const float> values);

}  // namespace kinemend
