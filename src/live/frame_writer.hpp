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

/// Cleaned frames as text, a line each.
class FrameWriter {
 public:
  FrameWriter(const LiveHeader& header, LiveFormat format);

  /// What stands before the frames. `latency_frames`: the delay.
  std::string header_text(std::size_t latency_frames) const;
  /// The channel values (degrees, file units) that the first frame's angles are chosen near to.
  void start_near(const std::vector<double>& values);
  /// A line with its end. Angles continue the frame before; a value that is no finite number is
  /// that of the frame before. Valid until the next call.
  std::string_view write(const Frame& frame, std::int64_t number);

 private:
  std::string bvh_header() const;
  std::string json_header(std::size_t latency_frames) const;
  void write_values(const Frame& frame);
  void write_json(const Frame& frame, std::int64_t number);
  void append(double value, unsigned decimals);
  void append(Vec3 v);

  LiveHeader header_;
  LiveFormat format_;
  MotionColumns columns_;
  std::vector<std::array<double, 3>> angles_;
  std::vector<double> row_;  ///< as written
  std::string line_;
};

}  // namespace kinemend
