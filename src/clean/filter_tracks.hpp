#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "clean/clip_tracks.hpp"
#include "tracks/rotation_track.hpp"

// Joints and positions of a clip as tracks that a filter of one track takes.
namespace kinemend {

RotationTrack load_rotations(const Clip& clip, std::size_t joint);
/// Several at once, which reads the frames in their order.
std::vector<RotationTrack> load_rotations(const Clip& clip, std::span<const std::size_t> joints);
void store_rotations(const RotationTrack& track, Clip& clip, std::size_t joint);
VectorTrack load_positions(const PositionTrack& positions, std::size_t frames);
void store_positions(const VectorTrack& track, const PositionTrack& positions);

/// 1 where the joint's rotation was measured and 0 where not, with `lane_room` zeros behind. Empty
/// when all of them were.
std::vector<double> observed_weights(const Clip& clip, std::size_t joint);

/// Runs `filter_rotations(track, observed_weights)` on each selected joint and
/// `filter_positions(track)` on each selected position track. The filter sees unobserved samples
/// interpolated, with weight 0; they come out interpolated between the filtered ones.
template <class FilterRotations, class FilterPositions>
CleanTrace filter_tracks(Clip& clip, const Selection& selection,
                         const FilterRotations& filter_rotations,
                         const FilterPositions& filter_positions) {
  CleanTrace trace;
  const std::vector<std::size_t> joints = selected_joints(clip, selection);
  bridge_gaps(clip, joints, trace);
  for_each_parallel(joints.size(), joints.size() * clip.frame_count(), [&](std::size_t i) {
    RotationTrack track = load_rotations(clip, joints[i]);
    filter_rotations(track, observed_weights(clip, joints[i]));
    store_rotations(track, clip, joints[i]);
  });
  bridge_gaps(clip, joints, trace);
  for (const PositionTrack& positions : selected_positions(clip, selection)) {
    VectorTrack track = load_positions(positions, clip.frame_count());
    filter_positions(track);
    store_positions(track, positions);
  }
  return trace;
}

}  // namespace kinemend
