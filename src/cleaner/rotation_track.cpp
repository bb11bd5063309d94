// Makes tracks with padding for whole vectors after their last frame.
#include "cleaner/rotation_track.hpp"

namespace kinemend {

VectorTrack::VectorTrack(std::size_t frame_count)
    : frames(frame_count),
      x(frame_count + lane_room),
      y(frame_count + lane_room),
      z(frame_count + lane_room) {}

RotationTrack::RotationTrack(std::size_t frame_count)
    : frames(frame_count),
      w(frame_count + lane_room, 1.0),
      x(frame_count + lane_room),
      y(frame_count + lane_room),
      z(frame_count + lane_room) {}

}  // namespace kinemend
