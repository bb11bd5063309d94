// Splits the bytes of a live stream into lines in bounded memory, reads the header of a skeleton or
// of markers, and recognises the lines of Axis Neuron, which come without a header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Splits bytes that arrive in pieces of any size into lines, in bounded memory.
class LineSplitter {
 public:
  enum class Found : std::uint8_t { nothing, line, too_long };

  explicit LineSplitter(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Removes bytes from the front of `bytes`, up to the end of a line, or all of them. A line ends
  /// with LF or CR, and with | if `bars_end_lines`. `line` does not include the line end and may be
  /// empty; it is valid until the next call.
  Found next(std::string_view& bytes, bool bars_end_lines, std::string_view& line);
  /// Ends the partial line.
  Found end(std::string_view& line);
  /// Discards the partial line.
  void drop();

 private:
  void add(std::string_view piece);

  std::size_t most_bytes_;
  std::string part_;
  bool is_too_long_ = false;
  bool is_given_ = false;  ///< `part_` was the last line
};

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

/// The form of a line "0 Char00 v v v ...".
struct NeuronForm {
  std::string_view avatar;        ///< the first word
  bool displaced = false;         ///< each joint has a position and a rotation; else only the first
  std::size_t skipped_words = 0;  ///< before the values of the joints
};
/// Returns none if the number of words fits neither form.
std::optional<NeuronForm> neuron_form(std::string_view line);

/// Returns the header of a BVH file with the 59 joints in the order of the broadcast: a person of
/// 1.75 m in a T-pose, in centimetres, at 60 Hz.
std::string neuron_skeleton(bool displaced);

}  // namespace kinemend
