#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli {

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

}  // namespace kinemend::cli
