// Splits bytes that arrive in pieces of any size into lines, in bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

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

}  // namespace kinemend
