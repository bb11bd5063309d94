// Defines the meaning of each column of a frame, and computes rotations from the columns' angles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

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

/// Replaces each NaN sample by the sample of the frame before; frame 0 uses `previous` (J). Marks
/// them in `observed` (same shape) unless that is null.
void hold_rotations(Quat* rotations, std::size_t frames, std::size_t joints, const Quat* previous,
                    std::uint8_t* observed);
/// `hold_rotations` for the position columns of rows of values; `previous` holds one value per
/// position column.
void hold_positions(double* rows, std::size_t frames, const MotionColumns& columns,
                    std::span<const double> previous);

bool is_gap(Quat q);

}  // namespace kinemend
