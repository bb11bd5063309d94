// The header of a live stream: a skeleton, or the names of markers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/skeleton.hpp"

namespace kinemend {

/// The header of a stream.
struct LiveHeader {
  Skeleton skeleton;                 ///< of a stream of joints
  std::vector<std::string> markers;  ///< their names; empty for a stream of joints
  double frame_rate_hz = 0;
  std::string hierarchy;   ///< as received, with LF as line ends, and none after the last line
  std::size_t frames = 0;  ///< as declared; 0 if missing
  std::string frame_time;  ///< as received; empty if unusable
  std::vector<std::string> repairs;  ///< messages
};

/// Reads a header, without the motion after it. `frame_rate_hz` overrides the rate of the header,
/// unless it is 0. Throws `unreadable_input`, naming the line; also if no joint has a channel.
LiveHeader read_live_header(std::string_view text, std::string_view name, double frame_rate_hz);

/// Whether a line of a stream begins a header: with HIERARCHY, or with ROOT unless `surely`.
bool begins_header(std::string_view line, bool surely);

/// Whether a line is the header of a stream of markers: `MARKERS 120 LASI,RASI`.
bool is_marker_header(std::string_view line);
/// Reads the header of a stream of markers. `frame_rate_hz` overrides the rate of the header,
/// unless it is 0. Throws `unreadable_input`.
LiveHeader read_marker_header(std::string_view line, double frame_rate_hz);

/// Gathers the lines of a header.
class HeaderLines {
 public:
  enum class Next : std::uint8_t {
    more,      ///< the line belongs to the header, which is not complete yet
    complete,  ///< the line was the last one of the header
    over,      ///< the header ended before this line
    too_long,
  };

  explicit HeaderLines(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  Next take(std::string_view line);
  const std::string& text() const { return text_; }
  void clear();

 private:
  std::size_t most_bytes_;
  std::string text_;
  bool in_motion_ = false, has_frames_ = false, has_time_ = false;
};

}  // namespace kinemend
