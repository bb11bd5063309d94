#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Text for people: words, figures and tables.
namespace kinemend {

enum class Align { left, right };

/// Rows of cells, each column as wide as its widest cell.
class Table {
 public:
  explicit Table(std::vector<Align> columns, std::size_t indent = 2)
      : columns_(std::move(columns)), indent_(indent) {}
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }
  std::string text() const;

 private:
  std::vector<Align> columns_;
  std::size_t indent_;
  std::vector<std::vector<std::string>> rows_;
};

/// Columns that a text takes on a terminal.
std::size_t display_width(std::string_view text);
/// Words broken into lines of at most `width`, each led by `indent` spaces and ended by a newline.
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

/// Control characters as \xNN, so that a name in a file can neither break a line nor command the
/// terminal, and words cut at 80 characters, so that it cannot fill it. Paths are left whole.
std::string printable(std::string_view text);

enum class Paint { bold, dim, red, green, yellow };
/// The text in the codes of a terminal; as it is where it is empty or `on` is false.
std::string painted(Paint paint, std::string_view text, bool on = true);

}  // namespace kinemend
