// Matches takes of either kind with a layout, and turns them into its channels and back, for joints
// and for markers.
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_anchors.hpp"
#include "body/body_correspondence.hpp"
#include "body/body_frame.hpp"
#include "body/body_rotations.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend::representation {

/// Fills the measured samples of `channels` in the frame of `guide`, which `channels` has copied;
/// with nullptr it finds the frame first.
void encode_joints(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                   const BodyChannels* guide, BodyChannels& channels);
void encode_markers(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const BodyChannels* guide, BodyChannels& channels);
/// Implements `decode_body` for one kind.
void decode_joints(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                   Take& clip, std::span<const std::uint8_t> chosen);
void decode_markers(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                    Take& clip, std::span<const std::uint8_t> chosen);

}  // namespace kinemend::representation

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

namespace {

using representation::RootMotion;

Quat heading_turn(double heading) { return exp({0, heading, 0}); }

void encode_track(const Take& clip, const BodyLayout& layout, const std::vector<Quat>& rotations,
                  std::size_t track, const BodyChannels* guide, const BodyMatch& match,
                  BodyChannels& channels) {
  const Quat from_reference = conjugate(layout.references[track]);
  const auto joint = static_cast<std::size_t>(match.tracks[track]);
  std::vector<std::size_t> frames;  // measured frames
  std::vector<Vec3> vectors;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (!clip.is_observed(f, joint)) continue;
    Vec3 v = log(normalized(from_reference * rotations[f]));
    if (guide != nullptr) {
      v = continue_rotation_vector(
          v, radians_per_degree * representation::channels_at(*guide, f, 3 * track));
    }
    frames.push_back(f);
    vectors.push_back(v);
  }
  if (guide == nullptr) representation::continue_vectors(vectors, clip.frame_rate_hz);
  for (std::size_t i = 0; i < frames.size(); ++i)
    representation::put_channels(channels, frames[i], 3 * track, degrees_per_radian * vectors[i]);
}

void encode_place(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                  const RootMotion& root, BodyChannels& channels) {
  const std::size_t channel = 3 * layout.track_count();
  const std::size_t track = representation::root_track(clip, match);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (!clip.is_position_observed(f, track)) continue;
    const Vec3 ahead = rotate(conjugate(heading_turn(channels.headings[f])),
                              root.positions[f] - channels.places[f]);
    representation::put_channels(
        channels, f, channel,
        channels.degrees_per_unit * (ahead - match.body_height * layout.place));
  }
}

}  // namespace

namespace representation {

void encode_joints(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                   const BodyChannels* guide, BodyChannels& channels) {
  const RootMotion root = root_motion(clip, match);
  if (guide == nullptr) follow_root(clip, layout, match, root, channels);
  for (std::size_t track = 0; track < layout.track_count(); ++track) {
    if (match.tracks[track] < 0) continue;
    encode_track(clip, layout, track_rotations(clip, match, root, channels, track), track, guide,
                 match, channels);
  }
  if (layout.with_place) encode_place(clip, layout, match, root, channels);
}

void decode_joints(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                   Take& clip, std::span<const std::uint8_t> chosen) {
  const std::size_t frames = clip.frame_count(), tracks = layout.track_count();
  check_fit(channels, layout, match, frames, chosen);
  const RootMotion root = root_motion(clip, match);
  const auto is_chosen = [&](std::size_t track) { return chosen.empty() || chosen[track] != 0; };
  for (std::size_t track = 0; track < tracks; ++track) {
    if (match.tracks[track] < 0 || !is_chosen(track)) continue;
    const auto joint = static_cast<std::size_t>(match.tracks[track]);
    for (std::size_t f = 0; f < frames; ++f) {
      Quat q =
          layout.references[track] * exp(radians_per_degree * channels_at(channels, f, 3 * track));
      if (track == 0) q = conjugate(root.ancestors[f]) * heading_turn(channels.headings[f]) * q;
      Quat& local = clip.rotation(f, joint);
      local = align_hemisphere(
          normalized(conjugate(match.before[track]) * q * conjugate(match.after[track])), local);
    }
  }
  if (!layout.with_place || !is_chosen(tracks)) return;
  for (std::size_t f = 0; f < frames; ++f) {
    const Vec3 ahead = (1 / channels.degrees_per_unit) * channels_at(channels, f, 3 * tracks) +
                       match.body_height * layout.place;
    place_root(clip, match, f,
               channels.places[f] + rotate(heading_turn(channels.headings[f]), ahead));
  }
}

void encode_markers(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const BodyChannels* guide, BodyChannels& channels) {
  if (guide == nullptr)
    follow_anchors(clip, layout, match, floor_height(clip, layout, match), channels);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const TurnAboutY turn(channels.headings[f]);
    for (std::size_t i = 0; i < layout.track_count(); ++i) {
      const auto marker = static_cast<std::size_t>(match.tracks[i]);
      if (match.tracks[i] < 0 || !clip.is_observed(f, marker)) continue;
      const Vec3 ahead =
          turn.back(upright_position(clip, match.upright, f, marker) - channels.places[f]);
      put_channels(channels, f, 3 * i,
                   channels.degrees_per_unit * (ahead - match.body_height * layout.means[i]));
    }
  }
}

void decode_markers(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                    Take& clip, std::span<const std::uint8_t> chosen) {
  check_fit(channels, layout, match, clip.frame_count(), chosen);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const TurnAboutY turn(channels.headings[f]);
    for (std::size_t i = 0; i < layout.track_count(); ++i) {
      if (match.tracks[i] < 0 || (!chosen.empty() && chosen[i] == 0)) continue;
      const Vec3 ahead = (1 / channels.degrees_per_unit) * channels_at(channels, f, 3 * i) +
                         match.body_height * layout.means[i];
      clip.position(f, static_cast<std::size_t>(match.tracks[i])) =
          rotate(conjugate(match.upright), channels.places[f] + turn(ahead));
    }
  }
}

}  // namespace representation

}  // namespace kinemend
