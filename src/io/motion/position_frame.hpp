// The meaning of a joint's position columns in each format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// The meaning of a joint's position columns: the clip's position is origin + R(turn) v, where v
/// holds the values of the columns, and `rest` along axes without a column.
struct PositionFrame {
  Vec3 rest;
  Vec3 origin;
  Quat turn;

  bool is_direct() const { return origin == Vec3{} && turn == Quat{}; }
  Vec3 to_clip(Vec3 file) const { return is_direct() ? file : origin + rotate(turn, file); }
  Vec3 to_file(Vec3 clip) const {
    return is_direct() ? clip : rotate(conjugate(turn), clip - origin);
  }
};

inline double& component(Vec3& v, Axis axis) {
  return axis == Axis::x ? v.x : axis == Axis::y ? v.y : v.z;
}
inline double component(const Vec3& v, Axis axis) {
  return axis == Axis::x ? v.x : axis == Axis::y ? v.y : v.z;
}

/// Returns frames in which positions replace the joint's offset, as in BVH.
std::vector<PositionFrame> offset_replacing_frames(const Skeleton& skeleton);
/// Returns frames in which positions are added to the joint's offset, in its rest frame (for the
/// root in the world's), as in AMC.
std::vector<PositionFrame> offset_adding_frames(const Skeleton& skeleton);

/// Returns the index of the frame for `MotionColumns::Position::translated`.
inline std::size_t frame_index(std::int32_t translated) {
  return translated < 0 ? 0 : static_cast<std::size_t>(translated) + 1;
}

/// Returns the clip's position in a frame for `MotionColumns::Position::translated`.
template <class AnyTake>  // may be const
auto& position_of(AnyTake& clip, std::size_t frame, std::int32_t translated) {
  return clip.positions[frame * clip.point_count() + frame_index(translated)];
}

}  // namespace kinemend
