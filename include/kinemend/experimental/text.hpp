// Text for people: words, figures and tables.
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
  /// Cells are escaped as `printable` does it, and of a long word the first 80 characters are kept.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  std::string text() const;

 private:
  std::vector<Align> columns_;
  std::size_t indent_;
  std::vector<std::vector<std::string>> rows_;
};

/// Columns that a text takes on a terminal.
std::size_t display_width(std::string_view text);
/// Words, escaped and broken into lines of at most `width`, each led by `indent` spaces and ended
/// by a newline.
/// The first line lacks its indent where `hanging` is set.
std::string wrap(std::string_view text, std::size_t indent, std::size_t width = 96,
                 bool hanging = false);

/// A figure for people: three significant digits, no exponent for what people read.
std::string figure(double value);
/// Digits in groups of three.
std::string grouped(std::size_t count);
/// "1 frame", "2 frames", "2,404 frames".
std::string counted(std::size_t count, std::string_view noun);
/// "2,404 frames at 120 Hz (20.03 s)".
std::string length_text(std::size_t frames, double frame_rate_hz);

// Text that comes from a file or the command line must neither command the terminal nor fill it.
// Characters that do (control characters, marks that turn the direction of text) and bytes that are
// no UTF-8 are shown as \xNN or \uNNNN; letters of any script stay. Both functions leave a text
// that they have made unchanged.

/// One name: escaped, and at most 80 characters of it.
std::string printable_name(std::string_view name);
/// A message or a path: escaped, with words cut at 80 characters (paths are left whole), and the
/// middle left out of what is longer than 2,000 bytes. `Error` and `Diagnostics` do this to every
/// message.
std::string printable(std::string_view text);

enum class Paint { bold, dim, red, green, yellow };
/// The text in the codes of a terminal; as it is where it is empty or `on` is false.
std::string painted(Paint paint, std::string_view text, bool on = true);

}  // namespace kinemend
