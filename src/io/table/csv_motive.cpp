// Reads the heads of OptiTrack Motive's tables: a line of facts, then rows of types, names,
// identities and kinds, and a row of axes.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/table/csv_head.hpp"

namespace kinemend {

namespace {

// Chosen by hand.
constexpr std::string_view motive_first_word = "Format Version";
constexpr std::size_t most_rows_above_axes = 12;

bool is_marker(const std::string& type) { return type == "Marker"; }

bool is_type(const std::string& cell) {
  constexpr std::array<std::string_view, 6> types{"Marker", "Rigid Body",  "Rigid Body Marker",
                                                  "Bone",   "Bone Marker", "Unlabeled Marker"};
  return std::find(types.begin(), types.end(), cell) != types.end();
}

class MotiveReader {
 public:
  explicit MotiveReader(const SourceText& text)
      : text_(text), lines_(text, after_byte_order_mark(text.bytes)) {}

  CsvHeader read() {
    // An export may omit the line of facts.
    HeadLines first = lines_;
    if (const Cells facts = first.take_cells(); !facts.empty() && facts[0] == motive_first_word) {
      read_facts(facts);
      lines_ = first;
    }
    find_rows();
    header_.labels_line = lines_.place();
    header_.style.separator = lines_.separator();
    header_.data_begin = lines_.next();
    header_.data_end = text_.bytes.size();
    for (std::size_t i = 0; i < axes_.size();) i += take_column(i);
    if (header_.groups.empty()) refuse();
    header_.style.commas =
        commas_of(text_.bytes.substr(header_.data_begin), header_.style.separator);
    if (!header_.ignored.empty()) header_.beside = "the columns of " + joined(other_types());
    return std::move(header_);
  }

 private:
  // Each fact follows its name.
  void read_facts(const Cells& row) {
    double captured = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      if (row[i] == "Export Frame Rate") header_.frame_rate_hz = number_of(row[i + 1]);
      if (row[i] == "Capture Frame Rate") captured = number_of(row[i + 1]);
      if (row[i] == "Length Units") header_.unit = row[i + 1];
    }
    if (!(header_.frame_rate_hz > 0)) header_.frame_rate_hz = captured;
  }

  void find_rows() {
    bool next_is_names = false;
    for (std::size_t i = 0; i < most_rows_above_axes && !lines_.at_end(); ++i) {
      Cells row = lines_.take_cells();
      if (!row.empty() && row[0] == "Frame") {
        axes_ = std::move(row);
        return;
      }
      const std::string& label = row.size() > 1 && row[0].empty() ? row[1] : empty_;
      const bool has_types = types_.empty() && std::any_of(row.begin(), row.end(), is_type);
      const bool has_kinds = std::any_of(row.begin(), row.end(), [](const std::string& cell) {
        return cell == "Position" || cell == "Rotation";
      });
      if (label == "Name" || (next_is_names && label.empty())) {
        names_ = std::move(row);
      } else if (has_types) {
        types_ = std::move(row);
      } else if (has_kinds) {
        kinds_ = std::move(row);
      }
      next_is_names = has_types;
    }
    throw text_.error_at(lines_.place(),
                         "expected the row Frame, Time (Seconds), X, Y, Z of a Motive export");
  }

  // Returns how many columns from here belong together.
  std::size_t take_column(std::size_t i) {
    if (i == 0) {
      header_.frame_column = 0;
      return 1;
    }
    if (axes_[i].substr(0, 4) == "Time" && axes_[i] != "TimeCode" && header_.time_column < 0) {
      header_.time_column = static_cast<std::int32_t>(i);
      return 1;
    }
    if (is_marker(at(types_, i)) && is_axis(i, "X") && is_axis(i + 1, "Y") && is_axis(i + 2, "Z") &&
        is_same(i, i + 1) && is_same(i, i + 2)) {
      header_.groups.push_back({CsvGroup::Kind::position, at(names_, i), {i, i + 1, i + 2, i + 2}});
      return 3;
    }
    if (!axes_[i].empty() || !at(types_, i).empty()) {
      header_.ignored.push_back(at(names_, i).empty() ? axes_[i] : at(names_, i));
      header_.style.mark_text(i);
    }
    return 1;
  }

  const std::string& at(const Cells& row, std::size_t i) const {
    return i < row.size() ? row[i] : empty_;
  }
  bool is_axis(std::size_t i, std::string_view axis) const {
    return at(axes_, i) == axis && (kinds_.empty() || at(kinds_, i) == "Position");
  }
  bool is_same(std::size_t a, std::size_t b) const {
    return at(types_, a) == at(types_, b) && at(names_, a) == at(names_, b);
  }

  std::vector<std::string> other_types() const {
    std::vector<std::string> types;
    for (std::size_t i = 1; i < axes_.size(); ++i) {
      const std::string& type = at(types_, i);
      if (is_type(type) && !is_marker(type) &&
          std::find(types.begin(), types.end(), type) == types.end()) {
        types.push_back(type);
      }
    }
    return types;
  }

  static std::string joined(const std::vector<std::string>& types) {
    return types.empty() ? "other things" : fmt::format("{}", fmt::join(types, ", "));
  }

  // Rejects exports of bodies and bones: their markers are positions of a model, not measurements.
  [[noreturn]] void refuse() const {
    throw text_.error_at(std::size_t{0},
                         fmt::format("a Motive export of {}, without measured markers: no "
                                     "markers to clean",
                                     quote(joined(other_types()))));
  }

  const SourceText& text_;
  HeadLines lines_;
  CsvHeader header_;
  Cells types_, names_, kinds_, axes_;
  std::string empty_;
};

}  // namespace

bool starts_as_motive_export(std::string_view text) {
  text.remove_prefix(after_byte_order_mark(text));
  const std::string_view line = line_from(text, 0);
  if (line.substr(line.substr(0, 1) == "\"" ? 1 : 0, motive_first_word.size()) == motive_first_word)
    return true;
  // Without the line of facts, the row of types is first.
  if (line.empty() || std::string_view(",;\t").find(line[0]) == std::string_view::npos)
    return false;
  const Cells cells = split_cells(line, line[0]);
  return cells.size() > 2 && (cells[1].empty() || cells[1] == "Type") &&
         std::any_of(cells.begin() + 2, cells.end(), is_type);
}

CsvHeader read_motive_header(const SourceText& text) { return MotiveReader(text).read(); }

}  // namespace kinemend
