// Turns rows of channel values into the frames of a take of joints.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_document.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Turns rows of channel values into the frames of a clip, whose skeleton is there already. Values
/// that are NaN are held from the frame before, or from the next one at the start.
class ClipRows {
 public:
  /// `position_frames`: see `MotionDocument`. `file_bytes`: how much was read, which bounds the
  /// memory.
  ClipRows(Take& clip, std::vector<PositionFrame> position_frames, std::size_t file_bytes);

  const MotionColumns& columns() const { return columns_; }
  std::size_t frames() const { return clip_.frame_count(); }
  /// Whether the clip may grow to so many frames.
  bool fits(std::size_t frames) const;
  /// Room for `expected` frames, but never for more than `most` or than may be.
  void reserve(std::size_t expected, std::size_t most);
  /// At most `columns().block_frames()` rows; held values replace the NaN ones in them.
  void append(double* rows, std::size_t count, bool with_gaps);
  /// After the last row: fills what stands before the first finite value, and tells the document
  /// what a rewrite needs to know of frame 0.
  void finish(MotionDocument& document, bool has_gaps);

 private:
  std::size_t bytes_per_frame() const;
  void hold(double* rows, std::size_t count, Quat* rotations);
  void append_positions(const double* rows, std::size_t count);
  void fill_leading_gaps();
  void fill_leading_positions(const MotionColumns::Position& position);
  const PositionFrame& frame_of(const MotionColumns::Position& position) const {
    return position_frames_[frame_index(position.translated)];
  }
  double& value(std::size_t frame, const MotionColumns::Position& position) {
    return component(position_of(clip_, frame, position.translated), position.axis);
  }

  Take& clip_;
  MotionColumns columns_;
  std::vector<PositionFrame> position_frames_;
  std::size_t joints_;
  std::size_t memory_limit_;
};

}  // namespace kinemend
