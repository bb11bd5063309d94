// Writes the cleaned frames of a live stream as text, one line each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/position_frame.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/live.hpp"
#include "live/live_header.hpp"

namespace kinemend {

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
