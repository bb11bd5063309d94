// Reads the frames of a live stream from lines of values, and writes the cleaned frames as text,
// one line each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/sessions.hpp"
#include "live/live_lines.hpp"

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

/// Writes cleaned frames as text, one line each.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;

  /// Returns the header. `latency_frames`: the delay.
  virtual std::string header_text(std::size_t latency_frames) const = 0;
  /// Sets the channel values of joints (degrees, file units) near which the angles of the first
  /// frame are chosen.
  virtual void start_near(const std::vector<double>& /*values*/) {}
  /// Returns a line with its line end, valid until the next call. A value that is not finite is
  /// replaced by that of the previous frame, or 0.
  std::string_view write(const Frame& frame, std::int64_t number);

 protected:
  virtual void append_frame(const Frame& frame, std::int64_t number) = 0;
  void append(std::string_view text) { line_ += text; }
  void append(double value, unsigned decimals);
  void append_json(Vec3 v);

 private:
  std::string line_;
};

/// Writes joints. Angles continue those of the previous frame.
class JointWriter final : public FrameWriter {
 public:
  JointWriter(const LiveHeader& header, LiveFormat format);
  std::string header_text(std::size_t latency_frames) const override;
  void start_near(const std::vector<double>& values) override;

 private:
  std::string bvh_header() const;
  std::string json_header(std::size_t latency_frames) const;
  void append_frame(const Frame& frame, std::int64_t number) override;
  void append_values(const Frame& frame);
  void append_json_frame(const Frame& frame, std::int64_t number);

  LiveHeader header_;
  LiveFormat format_;
  MotionColumns columns_;
  std::vector<std::array<double, 3>> angles_;
  std::vector<double> row_;  ///< as written
};

/// Writes markers. A missing one has empty cells, or is null in JSON.
class MarkerWriter final : public FrameWriter {
 public:
  MarkerWriter(const LiveHeader& header, LiveFormat format) : header_(header), format_(format) {}
  std::string header_text(std::size_t latency_frames) const override;

 private:
  void append_frame(const Frame& frame, std::int64_t number) override;

  LiveHeader header_;
  LiveFormat format_;
};

}  // namespace kinemend
