// Defines the meaning of each column of a frame: rotations from the columns' angles, with the same
// result on every machine, and positions in the frame of each format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Names of channels in BVH files and in the skeletons of CSV files, in the order of `Channel`.
inline constexpr std::array<std::string_view, 6> channel_names{
    "Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"};
/// Returns the channel of that name in any case; none for another word.
std::optional<Channel> channel_named(std::string_view word);

/// The meaning of the columns of a frame, and rotations from them.
class MotionColumns {
 public:
  struct Position {
    std::size_t column = 0;
    std::int32_t translated = -1;  ///< index in `translated_joints()`; -1 for joint 0
    Axis axis = Axis::x;
  };
  struct Rotation {
    std::array<std::size_t, 3> columns{};
    RotationOrder order;
  };

  explicit MotionColumns(const Skeleton& skeleton);

  std::size_t count() const { return count_; }
  std::span<const Position> positions() const { return positions_; }
  /// Returns one entry per joint; `order` has count 0 if the joint has no rotation channels.
  std::span<const Rotation> rotations() const { return rotations_; }
  std::span<const std::int32_t> translated_joints() const { return translated_joints_; }
  /// Returns the number of frames to decode at once, for speed.
  std::size_t block_frames() const { return block_frames_; }

  /// Computes R = product of the channels' rotations, left to right, for `frames` (at most
  /// `block_frames()`) rows of `count()` values in degrees. Writes frames x J. A joint with a value
  /// that is not finite gets NaN.
  void decode_rotations(const double* rows, std::size_t frames, Quat* rotations);

 private:
  std::size_t count_ = 0;
  std::size_t block_frames_ = 1;
  std::vector<Position> positions_;
  std::vector<Rotation> rotations_;
  std::vector<std::int32_t> translated_joints_;
  /// block_frames x J x 3; unused angles stay zero.
  std::vector<double> degrees_, sines_, cosines_;
};

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

/// Computes sin(a / 2) and cos(a / 2) of `count` angles a in degrees, each to within 2e-16 and the
/// same on every machine. Whole turns are removed exactly before rounding, so that right angles
/// give exact results. NaN and infinity give NaN.
void half_angle_sincos(const double* degrees, std::size_t count, double* sines, double* cosines);

}  // namespace kinemend
