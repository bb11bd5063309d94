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

/// Frames from lines of values.
class FrameReader {
 public:
  FrameReader(bool numbered, std::size_t skipped_words)
      : numbered_(numbered), skipped_words_(skipped_words) {}
  virtual ~FrameReader() = default;

  enum class Read : std::uint8_t {
    frame,
    number,  ///< it has no whole number where it should
    text,    ///< it does not begin like a frame
    values,  ///< other than as many values as there should be, or no values
  };
  /// Without `Read::frame` nothing has changed.
  Read read(std::string_view line);

  const Frame& frame() const { return frame_; }
  std::int64_t number() const { return number_; }  ///< of a numbered frame
  std::size_t gaps() const { return gaps_; }       ///< values of the frame that were not finite
  virtual std::size_t values_expected() const = 0;
  std::size_t values_found() const { return values_found_; }  ///< of the last line
  /// Of the frame, as they stood: of joints degrees and file units, by column.
  const std::vector<double>& values() const { return row_; }

 protected:
  virtual Read read_values(std::string_view line) = 0;

  Frame frame_;
  std::vector<double> row_;
  std::size_t gaps_ = 0;
  std::size_t values_found_ = 0;

 private:
  bool numbered_;
  std::size_t skipped_words_;
  std::int64_t number_ = 0;
};

/// Lines of channel values. A frame is whole: a value that is no finite number is that of the frame
/// before (at first, that of the rest pose), and its joint not observed.
class JointReader final : public FrameReader {
 public:
  JointReader(const Skeleton& skeleton, bool numbered, std::size_t skipped_words);
  std::size_t values_expected() const override { return columns_.count(); }

 private:
  Read read_values(std::string_view line) override;
  void take_rotations();
  void take_positions();

  MotionColumns columns_;
  std::vector<PositionFrame> position_frames_;
  std::vector<Quat> rotations_;
  std::vector<double> line_;
};

/// Lines of three cells a marker, with commas between them. A marker of which a cell is empty or no
/// finite number is not observed.
class MarkerReader final : public FrameReader {
 public:
  MarkerReader(std::size_t markers, bool numbered, std::size_t skipped_words);
  std::size_t values_expected() const override { return row_.size(); }

 private:
  Read read_values(std::string_view line) override;

  std::vector<double> line_;
};

}  // namespace kinemend
