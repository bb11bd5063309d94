#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/position_frame.hpp"
#include "kinemend/cleaner.hpp"

namespace kinemend {

/// Frames from lines of channel values.
class FrameReader {
 public:
  FrameReader(const Skeleton& skeleton, bool numbered, std::size_t skipped_words);

  enum class Read : std::uint8_t {
    frame,
    number,  ///< it has no whole number where it should
    text,    ///< it does not begin like a frame
    values,  ///< other than as many values as there are channels
  };
  /// A frame is whole: a value that is no finite number is that of the frame before (at first, that
  /// of the rest pose), and its joint not observed. Without `Read::frame` nothing has changed.
  Read read(std::string_view line);

  const Frame& frame() const { return frame_; }
  std::int64_t number() const { return number_; }  ///< of a numbered frame
  std::size_t gaps() const { return gaps_; }       ///< values of the frame that were none
  std::size_t values_expected() const { return columns_.count(); }
  std::size_t values_found() const { return values_found_; }  ///< of the last line
  /// Of the frame: degrees and file units, by column.
  const std::vector<double>& values() const { return row_; }

 private:
  void take_rotations();
  void take_positions();

  MotionColumns columns_;
  std::vector<PositionFrame> position_frames_;
  bool numbered_;
  std::size_t skipped_words_;
  Frame frame_;
  std::vector<Quat> rotations_;
  std::vector<double> row_, line_;
  std::int64_t number_ = 0;
  std::size_t gaps_ = 0;
  std::size_t values_found_ = 0;
};

}  // namespace kinemend
