// Turns rows of channel values into the frames of a take of joints.
#pragma once

#include <cstddef>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_document.hpp"
#include "kinemend/take.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

/// Turns rows of channel values into the frames of a clip that already has its skeleton. NaN values
/// hold the value of the previous frame, or of the next frame at the start.
class ClipRows {
 public:
  /// `position_frames`: see `MotionDocument`. `file_bytes`: size of the file, which bounds the
  /// memory.
  ClipRows(Take& clip, std::vector<PositionFrame> position_frames, std::size_t file_bytes);

  const MotionColumns& columns() const { return columns_; }
  std::size_t frames() const { return clip_.frame_count(); }
  /// Whether the clip may grow to this number of frames.
  bool fits(std::size_t frames) const;
  /// Reserves memory for `expected` frames, but not for more than `most` or than the limit.
  void reserve(std::size_t expected, std::size_t most);
  /// Appends at most `columns().block_frames()` rows.
  void append(const double* rows, std::size_t count);
  /// Call this after the last row: it replaces NaN, and stores in the document the values of frame
  /// 0 that a rewrite needs.
  void finish(MotionDocument& document, bool has_gaps);

 private:
  std::size_t bytes_per_frame() const;
  void append_positions(const double* rows, std::size_t count);
  void hold_gaps();
  const PositionFrame& frame_of(const MotionColumns::Position& position) const {
    return position_frames_[frame_index(position.translated)];
  }
  double& value(std::size_t frame, const MotionColumns::Position& position) {
    return component_of(position_of(clip_, frame, position.translated), position.axis);
  }

  Take& clip_;
  MotionColumns columns_;
  std::vector<PositionFrame> position_frames_;
  std::size_t joints_;
  std::size_t memory_limit_;
};

}  // namespace kinemend
