// Reads the frames of a live stream from lines of values.
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

/// Reads frames from lines of values.
class FrameReader {
 public:
  FrameReader(bool numbered, std::size_t skipped_words)
      : numbered_(numbered), skipped_words_(skipped_words) {}
  virtual ~FrameReader() = default;

  enum class Read : std::uint8_t {
    frame,
    number,  ///< the frame number is not a whole number
    text,    ///< the line does not begin like a frame
    values,  ///< too few or too many values, or text among them
  };
  /// Reads a line. Any result except `Read::frame` leaves the last frame unchanged.
  Read read(std::string_view line);

  const Frame& frame() const { return frame_; }
  std::int64_t number() const { return number_; }  ///< of the frame, if frames are numbered
  std::size_t gaps() const { return gaps_; }       ///< values of the frame that were not finite
  virtual std::size_t values_expected() const = 0;
  std::size_t values_found() const { return values_found_; }  ///< of the last line
  /// Returns the values of the frame as read. For joints: degrees and file units, by column.
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

/// Reads lines of channel values. A value that is not finite is replaced by that of the previous
/// frame (at first, of the rest pose), and its joint is marked as not observed.
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

/// Reads lines of three cells per marker, separated by commas. A marker with an empty or non-finite
/// cell is not observed.
class MarkerReader final : public FrameReader {
 public:
  MarkerReader(std::size_t markers, bool numbered, std::size_t skipped_words);
  std::size_t values_expected() const override { return row_.size(); }

 private:
  Read read_values(std::string_view line) override;

  std::vector<double> line_;
};

}  // namespace kinemend
