// Reads the lines above the rows of a TRC file, in all its dialects.
#include "io/table/trc_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

bool begins_with(std::string_view text, std::string_view word) {
  return equal_ignoring_case(text.substr(0, word.size()), word);
}

// Whether a character belongs to a line that holds only separators and quotes.
bool is_filler(char c) { return is_space(c) || c == ',' || c == ';' || c == '"'; }

bool is_empty(std::string_view line) { return std::all_of(line.begin(), line.end(), is_filler); }

// Returns the separator: tabs, or spaces in some files; spreadsheets write commas, or semicolons if
// commas are decimal.
char trc_separator(std::string_view line) {
  for (const char separator : {'\t', ';', ','}) {
    if (line.find(separator) != line.npos) return separator;
  }
  return ' ';
}

std::vector<std::string> without_empty(std::vector<std::string> cells) {
  cells.erase(std::remove(cells.begin(), cells.end(), std::string()), cells.end());
  return cells;
}

class TrcHeaderReader {
 public:
  TrcHeaderReader(const SourceText& text, Diagnostics& diagnostics)
      : text_(text), diagnostics_(diagnostics) {}

  TrcHeader read() {
    if (is_empty(text_.bytes)) throw Error::at_line(text_.name, 1, "the file is empty");
    next_ = byte_order_mark_size(text_.bytes);
    while (header_.labels_line == 0) read_line();
    read_below_labels();
    choose_style();
    note_separator();
    return std::move(header_);
  }

 private:
  // Returns the separator of values. A head with commas has values with commas; in a head with
  // spaces commas may be decimal.
  char separator_in(std::string_view line) const {
    if (line.find('\t') != line.npos) return '\t';
    return head_separator_ == '\t' ? ' ' : head_separator_;
  }

  std::string_view take_line() {
    place_ = next_;
    next_ = next_line(text_.bytes, next_);
    return line_from(text_.bytes, place_);
  }

  void read_line() {
    if (next_ == text_.bytes.size()) {
      throw text_.error_at(next_,
                           "expected the row of labels (Frame#, Time, names of markers), "
                           "found the end of the file");
    }
    const std::string_view line = take_line();
    if (is_empty(line)) return;
    if (static_cast<std::size_t>(std::count_if(line.begin(), line.end(), is_filler)) >
        6 * most_markers) {
      throw text_.error_at(place_, fmt::format("at most {} markers can be read", most_markers));
    }
    if (head_separator_ == 0) head_separator_ = trc_separator(line);
    const std::vector<std::string> cells = split_cells(line, separator_in(line));
    const auto key = std::find_if(cells.begin(), cells.end(), [](const std::string& cell) {
      return equal_ignoring_case(cell, "DataRate");
    });
    if (begins_with(cells[0], "PathFileType")) {
      header_.first_line = line;
      if (cells.size() > 3) header_.first_cell = cells[3];
    } else if (key != cells.end()) {
      header_.keys = without_empty(cells);
      const std::string_view values = take_line();
      header_.values = without_empty(split_cells(values, separator_in(values)));
      header_.values_line = place_;
    } else if (begins_with(cells[0], "Frame")) {
      labels_separator_ = separator_in(line);
      read_labels(cells, labels_separator_);
    } else {
      throw text_.error_at(
          place_, fmt::format("expected {}, found {}",
                              header_.first_line.empty() && header_.keys.empty() ? "PathFileType"
                              : header_.keys.empty() ? "DataRate and the other keys"
                                                     : "Frame#, Time and names of markers",
                              quote(line)));
    }
  }

  void read_labels(std::vector<std::string> cells, char separator) {
    header_.labels_line = place_;
    header_.has_time = cells.size() > 1 && begins_with(cells[1], "Time");
    cells.erase(cells.begin(), cells.begin() + (header_.has_time ? 2 : 1));
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    if (separator == ' ') {
      header_.labels = std::move(cells);
      return;
    }
    constexpr std::size_t stride = 3;
    const bool above_x =
        std::all_of(cells.begin(), cells.end(), [&, i = std::size_t{0}](const auto& cell) mutable {
          return i++ % stride == 0 || cell.empty();
        });
    const bool thrice = !above_x && cells.size() % stride == 0 && is_thrice(cells);
    if (!above_x) {
      note_repair(text_, diagnostics_, "label_layout", place_,
                  thrice ? "each name is above all its three columns"
                         : "names are not above the first of three columns");
    }
    if (above_x || thrice) {
      for (std::size_t i = 0; i < cells.size(); i += stride) header_.labels.push_back(cells[i]);
    } else {
      header_.labels = without_empty(std::move(cells));
    }
  }

  static bool is_thrice(const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); i += 3) {
      if (cells[i].empty() || cells[i + 1] != cells[i] || cells[i + 2] != cells[i]) return false;
    }
    return true;
  }

  // Reads the row of X1, Y1, Z1 and the blank line; both may be missing.
  void read_below_labels() {
    bool has_axes = false, has_blank = false;
    header_.data_begin = next_;
    while (next_ != text_.bytes.size()) {
      const std::string_view line = take_line();
      const std::size_t first = line.find_first_not_of(" \t\v\f\",;");
      if (first == line.npos) {
        has_blank = true;
      } else if (std::string_view("XYZxyz").find(line[first]) != std::string_view::npos &&
                 !has_axes) {
        has_axes = true;
      } else {
        header_.data_begin = place_;
        break;
      }
      header_.data_begin = next_;
    }
    if (!has_axes && !header_.labels.empty()) {
      note_repair(text_, diagnostics_, "axis_row_missing", header_.labels_line,
                  "the row of X1, Y1, Z1 is missing");
    }
    if (!has_blank) {
      note_repair(text_, diagnostics_, "blank_row_missing", header_.data_begin,
                  "the blank line before the first frame is missing");
    }
  }

  void choose_style() {
    const std::string_view rows = text_.bytes.substr(header_.data_begin);
    const std::string_view line = line_from(rows, 0);
    // Rows use the labels' separator if they contain it, but tabs take precedence.
    char separator = '\t';
    if (line.find('\t') == line.npos) {
      const bool as_labels = labels_separator_ != ' ' && line.find(labels_separator_) != line.npos;
      separator = as_labels                            ? labels_separator_
                  : line.find(';') != line.npos        ? ';'
                  : split_cells(line, ' ').size() >= 2 ? ' '
                                                       : '\t';
    }
    header_.style.separator = separator;
    const std::vector<std::string> cells = split_cells(line, separator);
    refuse_commas_of_two_kinds(rows);
    const bool decimal = separator == ','
                             ? std::any_of(cells.begin(), cells.end(),
                                           [](const auto& c) { return c.find(',') != c.npos; })
                             : rows.find(',') != rows.npos;
    if (!decimal) return;
    header_.style.commas = CommaStyle::decimal;
    note_repair(text_, diagnostics_, "decimal_comma", header_.data_begin,
                "numbers have decimal commas");
  }

  // Rejects rows with commas and no point: digits after decimal commas would be read as cells.
  void refuse_commas_of_two_kinds(std::string_view rows) const {
    if (header_.style.separator != ',' || rows.find_first_of(".\"") != rows.npos) return;
    throw text_.error_at(header_.data_begin,
                         "decimal commas and commas between cells cannot be told apart");
  }

  void note_separator() {
    const char separator = header_.style.separator;
    if (separator == '\t') return;
    const bool spaces = separator == ' ';
    note_repair(
        text_, diagnostics_, spaces ? "space_separator" : "comma_separator", header_.data_begin,
        fmt::format("{} separate the cells instead of tabs", spaces             ? "spaces"
                                                             : separator == ',' ? "commas"
                                                                                : "semicolons"));
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  TrcHeader header_;
  char head_separator_ = 0;  // separator of the first line
  char labels_separator_ = '\t';
  std::size_t place_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

std::string_view TrcHeader::value(std::string_view key) const {
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
    if (equal_ignoring_case(keys[i], key)) return values[i];
  }
  return {};
}

double TrcHeader::number(std::string_view key) const {
  const std::string_view text = value(key);
  if (!text.empty()) {
    const NumberToken token =
        read_number(text.data(), text.data() + text.size(), CommaStyle::decimal);
    if (token.kind == TokenKind::number) return token.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TrcHeader read_trc_header(const SourceText& text, Diagnostics& diagnostics) {
  return TrcHeaderReader(text, diagnostics).read();
}

}  // namespace kinemend
