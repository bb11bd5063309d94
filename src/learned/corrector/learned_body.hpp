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
#include "learned/corrector/motion_channels.hpp"
#include "learned/corrector/motion_network.hpp"

namespace kinemend {

/// Of what the network has learned from. Chosen by hand, as its training was.
inline constexpr double shortest_learned_take_s = 0.5, lowest_learned_rate_hz = 20;

/// Why the method has no say in a take; empty: it has one.
std::string why_not_learned(const TakeView& view);

/// How far the poses of a body may be from those that the network has learned, in deviations of its
/// channels (root mean square of the mean pose). Takes of the rigs that it knows have 0.3 to 1.1,
/// under noise too; takes of 20 other rigs with the same names 1.3 to 17: their rest poses or bone
/// axes differ (docs/methods/learned.md).
inline constexpr double most_pose_distance = 1.2;
/// The same of a joint in a body that fits. The farthest of a known rig had 3.4.
inline constexpr double most_joint_distance = 4;

struct KnownBody {
  BodyMatch match;
  Take clip;  ///< without spikes
  BodyChannels channels;
  std::vector<std::int32_t> track_of;  ///< N and the place: the track among those cleaned, or -1
};

/// The joints of a take as the model sees them.
struct BodyReading {
  std::optional<KnownBody> body;  ///< nothing where the model knows too little of the take
  double distance = 0;            ///< of its poses, where joints were found by name; see above
  /// Tracks of joints that were found by name and left out for their poses.
  std::vector<std::size_t> strange;
};

/// Matches joints by name and keeps those whose poses are of the kind that the network has learned.
/// A body whose poses are not is no known body: its joints are cleaned one by one.
BodyReading read_body(const BodyLayout& layout, const MotionNetwork& network, const NameMap& names,
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
