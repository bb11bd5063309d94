// Turns a clip into the channels of a layout of joints, and back.
#include <cmath>
#include <vector>

#include "body/body_frame.hpp"
#include "body/body_kinds.hpp"
#include "body/body_rotations.hpp"
#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/representation.hpp"

namespace kinemend {

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

}  // namespace representation

}  // namespace kinemend
