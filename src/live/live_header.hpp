#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/skeleton.hpp"

namespace kinemend {

/// The head of a stream.
struct LiveHeader {
  Skeleton skeleton;                 ///< of joints
  std::vector<std::string> markers;  ///< their names; empty of a stream of joints
  double frame_rate_hz = 0;
  std::string hierarchy;   ///< as it came, lines ended by LF, without an end of its last line
  std::size_t frames = 0;  ///< as declared; 0 where it is not
  std::string frame_time;  ///< as it came; empty where it is of no use
  std::vector<std::string> repairs;  ///< for people
};

/// Reads a header, and nothing of the motion behind it. `frame_rate_hz` goes over the header's,
/// unless it is 0. Errors: `unreadable_input`, naming the line; also where no joint has a channel.
LiveHeader read_live_header(std::string_view text, std::string_view name, double frame_rate_hz);

/// Whether a line of a stream begins a header: with HIERARCHY, or with ROOT unless `surely`.
bool begins_header(std::string_view line, bool surely);

/// Whether a line is the header of a stream of markers: `MARKERS 120 LASI,RASI`.
bool is_marker_header(std::string_view line);
/// Reads one. `frame_rate_hz` goes over the header's, unless it is 0. Errors: `unreadable_input`.
LiveHeader read_marker_header(std::string_view line, double frame_rate_hz);

/// Gathers the lines of a header.
class HeaderLines {
 public:
  enum class Next : std::uint8_t {
    more,      ///< the line belongs to it, and more is to come
    complete,  ///< the line was its last
    over,      ///< it ended before this line, which is not part of it
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
