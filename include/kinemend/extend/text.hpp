// Text for people: words, figures and tables. Text from outside: byte order marks, letters without
// regard to case, patterns of names, and how deeply JSON may nest.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend {

enum class Align { left, right };

/// Rows of cells, each column as wide as its widest cell.
class Table {
 public:
  explicit Table(std::vector<Align> columns, std::size_t indent = 2)
      : columns_(std::move(columns)), indent_(indent) {}
  /// Adds a row. Cells are escaped as by `printable`, and a word is cut after 80 characters.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  std::string text() const;

 private:
  std::vector<Align> columns_;
  std::size_t indent_;
  std::vector<std::vector<std::string>> rows_;
};

/// Returns the columns that a text takes on a terminal.
std::size_t display_width(std::string_view text);
/// Escapes words and breaks them into lines of at most `width`. Each line begins with `indent`
/// spaces and ends with a newline. The first line has no indent if `hanging` is set.
std::string wrap(std::string_view text, std::size_t indent, std::size_t width = 96,
                 bool hanging = false);

/// Returns a figure for people: three significant digits, without an exponent for usual sizes.
std::string figure(double value);
/// Returns digits in groups of three.
std::string grouped(std::size_t count);
/// "1 frame", "2 frames", "2,404 frames".
std::string counted(std::size_t count, std::string_view noun);
/// "2,404 frames at 120 Hz (20.03 s)".
std::string length_text(std::size_t frames, double frame_rate_hz);

// Text from a file or the command line must neither control the terminal nor fill it. Control
// characters, marks that change the direction of text, and bytes that are not UTF-8 are shown as
// \xNN or \uNNNN; letters of any script are kept. Applying either function twice changes nothing
// more.

/// Returns a name, escaped and cut after 80 characters.
std::string printable_name(std::string_view name);
/// Returns a message or a path, escaped, with words cut after 80 characters (paths are not cut).
/// The middle of a text longer than 2,000 bytes is left out. `Error` and `Diagnostics` do this to
/// every message.
std::string printable(std::string_view text);

/// Returns the number of bytes of the byte order mark that some programs put before UTF-8: 3, or 0
/// for a text that does not begin with it.
std::size_t byte_order_mark_size(std::string_view text);
/// Returns the text without that mark.
std::string_view without_byte_order_mark(std::string_view text);

enum class Paint { bold, dim, red, green, yellow };
/// Returns the text with terminal codes; unchanged if it is empty or `on` is false.
std::string painted(Paint paint, std::string_view text, bool on = true);

/// Converts A to Z to a to z, whatever the locale, and keeps every other byte.
char lower_case(char letter);
std::string lower_case(std::string_view text);
/// Whether two texts are equal except for case (ASCII).
bool same_but_for_case(std::string_view a, std::string_view b);

/// Whether a name matches a pattern with `*`, `?` and `[a-z]`, `[!a]`, `[[:digit:]]`; a backslash
/// escapes the next character. Works on bytes. Uses `fnmatch` of the system if it is glibc's.
bool matches_wildcards(const std::string& pattern, const std::string& name);

/// `matches_wildcards` without the system's `fnmatch`, on every system.
bool matches_wildcards_anywhere(std::string_view pattern, std::string_view name);

/// The largest accepted depth of nested arrays and objects. Files of the program have five levels.
inline constexpr std::size_t deepest_json = 64;

/// Returns `text` up to the bracket that opens a level deeper than `deepest_json`, else the whole
/// text. A parser reports the result as it reports any truncated text. Takes linear time and no
/// memory. Never throws.
std::string_view json_within_depth(std::string_view text);

/// Parses text from outside with `Json::parse`. Code that walks through a value recurses for every
/// level, so a deeply nested value would exhaust the stack. `Json`: `nlohmann::json` or
/// `nlohmann::ordered_json`. Errors: `Json::parse_error`, whose `byte` is the position; returns a
/// discarded value instead if `throws` is false.
template <class Json>
Json parse_json(std::string_view text, bool throws = true) {
  return Json::parse(json_within_depth(text), nullptr, throws);
}

}  // namespace kinemend
