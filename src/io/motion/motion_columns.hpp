// The meaning of each column of a frame, and rotations from the columns' angles.
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
  /// One a joint; count 0 in `order` where it has no rotation channels.
  std::span<const Rotation> rotations() const { return rotations_; }
  std::span<const std::int32_t> translated_joints() const { return translated_joints_; }
  /// Frames that are best decoded at once.
  std::size_t block_frames() const { return block_frames_; }

  /// R = product of the channels' rotations, left to right, for `frames` (at most `block_frames()`)
  /// rows of `count()` values in degrees. Writes frames x J. A joint with a value that is not
  /// finite gets NaN.
  void decode_rotations(const double* rows, std::size_t frames, Quat* rotations);

 private:
  std::size_t count_ = 0;
  std::size_t block_frames_ = 1;
  std::vector<Position> positions_;
  std::vector<Rotation> rotations_;
  std::vector<std::int32_t> translated_joints_;
  std::vector<double> degrees_, sines_,
      cosines_;  ///< block_frames x J x 3; unused angles stay zero
};

/// Gives each NaN sample the one of the frame before; frame 0 takes `previous` (J). Marks them in
/// `observed` (same shape) unless that is null.
void hold_rotations(Quat* rotations, std::size_t frames, std::size_t joints, const Quat* previous,
                    std::uint8_t* observed);
/// The same for the position columns of rows of values; `previous` holds one value a position
/// column.
void hold_positions(double* rows, std::size_t frames, const MotionColumns& columns,
                    std::span<const double> previous);

bool is_gap(Quat q);

}  // namespace kinemend
