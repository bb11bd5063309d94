// Matches, encodes and decodes takes of either kind.
#include "body/body_correspondence.hpp"
#include "body/body_frame.hpp"
#include "body/body_kinds.hpp"
#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

BodyChannels encode_take(const Take& take, const BodyLayout& layout, const BodyMatch& match,
                         const BodyChannels* guide) {
  const std::size_t frames = take.frame_count();
  BodyChannels channels;
  channels.frame_rate_hz = window_rate_hz(take.frame_rate_hz);
  channels.degrees_per_unit = representation::degrees_per_unit(match);
  channels.poses = PoseMatrix(frames, layout.channel_count());
  channels.observed.assign(frames * layout.channel_count(), 0);
  if (guide != nullptr) representation::take_frame(*guide, layout, frames, channels);
  if (take.has_joints()) {
    representation::encode_joints(take, layout, match, guide, channels);
  } else {
    representation::encode_markers(take, layout, match, guide, channels);
  }
  representation::hold_last_seen(channels.poses, channels.observed);
  return channels;
}

}  // namespace

BodyMatch match_body(const BodyLayout& layout, const Take& take, const NameMap& names) {
  return take.has_joints() ? representation::match_body_of_joints(layout, take, names)
                           : representation::match_body_of_markers(layout, take, names);
}

BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match) {
  return encode_take(take, layout, match, nullptr);
}

BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match,
                         const BodyChannels& guide) {
  return encode_take(take, layout, match, &guide);
}

void decode_body(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                 Take& take, std::span<const std::uint8_t> chosen) {
  if (take.has_joints()) {
    representation::decode_joints(channels, layout, match, take, chosen);
  } else {
    representation::decode_markers(channels, layout, match, take, chosen);
  }
}

}  // namespace kinemend
