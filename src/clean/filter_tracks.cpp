#include "clean/filter_tracks.hpp"

namespace kinemend {

RotationTrack load_rotations(const Clip& clip, std::size_t joint) {
  RotationTrack track(clip.frame_count());
  for (std::size_t f = 0; f < track.frames; ++f) track.set(f, clip.rotation(f, joint));
  return track;
}

std::vector<RotationTrack> load_rotations(const Clip& clip, std::span<const std::size_t> joints) {
  std::vector<RotationTrack> tracks(joints.size(), RotationTrack(clip.frame_count()));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t i = 0; i < joints.size(); ++i) tracks[i].set(f, clip.rotation(f, joints[i]));
  }
  return tracks;
}

void store_rotations(const RotationTrack& track, Clip& clip, std::size_t joint) {
  for (std::size_t f = 0; f < track.frames; ++f) clip.rotation(f, joint) = track[f];
}

VectorTrack load_positions(const PositionTrack& positions, std::size_t frames) {
  VectorTrack track(frames);
  for (std::size_t f = 0; f < frames; ++f) track.set(f, positions.values[f * positions.stride]);
  return track;
}

void store_positions(const VectorTrack& track, const PositionTrack& positions) {
  for (std::size_t f = 0; f < track.frames; ++f) positions.values[f * positions.stride] = track[f];
}

std::vector<double> observed_weights(const Clip& clip, std::size_t joint) {
  std::vector<double> weights(clip.frame_count() + lane_room);
  bool all = true;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    weights[f] = clip.is_observed(f, joint) ? 1.0 : 0.0;
    all = all && weights[f] != 0;
  }
  if (all) weights.clear();
  return weights;
}

}  // namespace kinemend
