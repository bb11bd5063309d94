// Reads the lines above the rows of a CSV file (notes and groups of columns), guesses separators
// and decimal commas, and keeps the other data of a table through a conversion.
#include "io/table/csv_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kinemend/extend/text.hpp"

namespace kinemend {

std::shared_ptr<const SourceDocument> CsvDocument::after(const TakeChange& /*change*/) const {
  if (beside.empty()) return nullptr;
  auto rest = std::make_shared<TableRest>();
  rest->beside = beside;
  return rest;
}

std::shared_ptr<const SourceDocument> TableRest::after(const TakeChange& /*change*/) const {
  return std::make_shared<TableRest>(*this);
}

namespace {

// Chosen by hand.
constexpr std::size_t most_head_lines = 32;

enum class Part : std::uint8_t { w, x, y, z, tx, ty, tz, none };

Part part_of(std::string_view text) {
  constexpr std::array<std::string_view, 7> names{"w", "x", "y", "z", "tx", "ty", "tz"};
  const std::string name = lower_case(text);
  const auto* const found = std::find(names.begin(), names.end(), name);
  return static_cast<Part>(found - names.begin());
}

struct Column {
  std::string label;
  Part part = Part::none;
};

// `LASI_x`, `LASI.X`, `LASI X`, `LASI:X`, `LASI-x`; a part alone (`x`) is not the column of a
// marker.
Column column_of(const std::string& cell) {
  const std::size_t cut = cell.find_last_of("_.: -");
  if (cut == cell.npos || (cut == 0 && cell[0] != '_')) return {cell, Part::none};
  const Part part = part_of(std::string_view(cell).substr(cut + 1));
  if (part == Part::none) return {cell, Part::none};
  return {cell.substr(0, cut), part};
}

struct TimeUnit {
  double seconds = 1;
  bool is_named = false;
};

// The unit of a column of times, by its label: `time_s`, `timestamp (ms)`, `time_us`, `t`.
std::optional<TimeUnit> time_unit_of(const std::string& name) {
  if (name == "seconds") return TimeUnit{1, true};
  if (name == "milliseconds") return TimeUnit{1e-3, true};
  if (name == "t") return TimeUnit{};
  if (name.substr(0, 4) != "time") return std::nullopt;
  const auto ends_with_unit = [&](std::string_view unit) {
    const std::size_t at = name.rfind(unit);
    if (at == name.npos || at < 4) return false;
    const bool is_word = std::isalpha(static_cast<unsigned char>(name[at - 1])) == 0;
    const std::string_view rest = std::string_view(name).substr(at + unit.size());
    return is_word && rest.find_first_not_of(")]") == rest.npos;
  };
  const auto names = [&](std::string_view word) { return name.find(word) != name.npos; };
  if (ends_with_unit("ns") || names("nano")) return TimeUnit{1e-9, true};
  if (ends_with_unit("us") || names("micro") || names("\u00b5s")) return TimeUnit{1e-6, true};
  // "timestamp" ends in no unit.
  if (names("ms") || names("milli")) return TimeUnit{1e-3, true};
  return TimeUnit{1, ends_with_unit("s") || ends_with_unit("sec") || names("second")};
}

class CsvHeaderReader {
 public:
  explicit CsvHeaderReader(const SourceText& text)
      : text_(text), lines_(text, byte_order_mark_size(text.bytes)) {}

  CsvHeader read() {
    if (without_spaces_around(text_.bytes.substr(lines_.next())).empty()) {
      throw Error::at_line(text_.name, 1, "the file is empty");
    }
    while (header_.groups.empty()) read_line();
    header_.data_begin = lines_.next();
    header_.data_end = text_.bytes.size();
    read_units_below();
    read_notes();
    header_.style.commas =
        commas_of(text_.bytes.substr(header_.data_begin), header_.style.separator);
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail() const {
    throw text_.error_at(
        first_row_.value_or(lines_.place()),
        "expected a row of labels such as frame,time_s,LASI_x,LASI_y,LASI_z, found none");
  }

  void read_line() {
    if (lines_.at_end() || above_.size() == most_head_lines) fail();
    const std::string_view line = lines_.take(), bare = without_spaces_around(line);
    if (bare.empty()) return;
    if (bare[0] == '#') return read_note(bare);
    // Spreadsheets read this line.
    if (lines_.place() == byte_order_mark_size(text_.bytes) && bare.substr(0, 4) == "sep=") return;
    if (!first_row_) first_row_ = lines_.place();
    const char separator = separator_of(line);
    if (static_cast<std::size_t>(std::count(line.begin(), line.end(), separator)) > most_columns) {
      throw text_.error_at(lines_.place(),
                           fmt::format("at most {} columns can be read", most_columns));
    }
    header_.style.separator = separator;
    header_.labels_line = lines_.place();
    Cells cells = split_cells(line, separator);
    std::vector<Column> columns;
    for (const std::string& cell : cells) columns.push_back(column_of(cell));
    group(columns);
    const bool names_in_line = !header_.groups.empty();
    if (!names_in_line) group(columns_below(cells));
    if (!header_.groups.empty()) {
      header_.foreign_lines = above_.size() - (names_in_line || above_.empty() ? 0 : 1);
      header_.foreign_place = *first_row_;
      return find_leading_columns(cells);
    }
    above_.push_back(std::move(cells));
  }

  void read_note(std::string_view line) {
    line = without_spaces_around(line.substr(1));
    const std::size_t colon = line.find(':');
    if (colon == line.npos) return;
    header_.notes.push_back({lower_case(without_spaces_around(line.substr(0, colon))),
                             std::string(without_spaces_around(line.substr(colon + 1))),
                             lines_.place()});
  }

  // Returns the columns of a row of axes (X, Y, Z, X, ...), whose names are in the row above.
  std::vector<Column> columns_below(const Cells& axes) const {
    std::vector<Column> columns(axes.size());
    const Cells* const names = above_.empty() ? nullptr : &above_.back();
    std::string name;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (names != nullptr && i < names->size() && !(*names)[i].empty()) name = (*names)[i];
      columns[i] = {name, part_of(axes[i])};
    }
    return columns;
  }

  void group(const std::vector<Column>& columns) {
    for (std::size_t i = 0; i < columns.size();) {
      i += std::max<std::size_t>(1, group_at(columns, i));
    }
  }

  std::size_t group_at(const std::vector<Column>& columns, std::size_t i) {
    using enum Part;
    const auto is = [&](std::size_t first, std::initializer_list<Part> parts) {
      for (const Part part : parts) {
        if (first >= columns.size() || columns[first].part != part) return false;
        if (columns[first].label != columns[i].label) return false;
        ++first;
      }
      return true;
    };
    const auto add = [&](CsvGroup::Kind kind, std::array<std::size_t, 4> places, std::size_t size) {
      header_.groups.push_back({kind, columns[i].label, places});
      return size;
    };
    if (is(i, {w, x, y, z})) return add(CsvGroup::Kind::rotation, {i, i + 1, i + 2, i + 3}, 4);
    if (is(i, {tx, ty, tz})) return add(CsvGroup::Kind::translation, {i, i + 1, i + 2, i + 2}, 3);
    // The root's position may precede the rotation of a joint called root.
    if (is(i, {x, y, z, w}) && !is(i + 3, {w, x, y, z})) {
      return add(CsvGroup::Kind::rotation, {i + 3, i, i + 1, i + 2}, 4);
    }
    if (is(i, {x, y, z})) return add(CsvGroup::Kind::position, {i, i + 1, i + 2, i + 2}, 3);
    return 0;
  }

  void find_leading_columns(const Cells& cells) {
    std::vector<bool> grouped(cells.size());
    for (const CsvGroup& group : header_.groups) {
      for (const std::size_t column : group.columns) grouped[column] = true;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (grouped[i]) continue;
      const std::string name = lower_case(cells[i]);
      if (!name.empty()) header_.labelled_columns = i + 1;
      const auto unit = time_unit_of(name);
      if (unit && header_.time_column < 0) {
        header_.time_column = static_cast<std::int32_t>(i);
        header_.seconds_per_time = unit->seconds;
        header_.time_has_unit = unit->is_named;
      } else if (name.substr(0, 5) == "frame" && header_.frame_column < 0) {
        header_.frame_column = static_cast<std::int32_t>(i);
      } else if (!name.empty() && name != "sub frame") {
        header_.ignored.push_back({cells[i], i});
        header_.style.mark_text(i);
      }
    }
  }

  // Reads a row of units below the axes.
  void read_units_below() {
    const std::string_view line = line_from(text_.bytes, lines_.next());
    for (const std::string& cell : split_cells(line, header_.style.separator)) {
      if (cell.empty()) continue;
      if (metres_per_unit(cell) == 0) return;
      header_.unit = cell;
    }
    if (!header_.unit.empty() && !without_spaces_around(line).empty() &&
        line.find_first_of("0123456789") == line.npos) {
      header_.data_begin = next_line(text_.bytes, lines_.next());
    }
  }

  void read_notes() {
    for (const CsvNote& note : header_.notes) {
      if (note.key == "rate_hz" || note.key == "frame_rate_hz" || note.key == "frame_rate" ||
          note.key == "rate" || note.key == "fps") {
        header_.frame_rate_hz = number_of(note.value);
      } else if (note.key == "units" || note.key == "unit") {
        header_.unit = note.value;
      }
    }
    if (!(header_.frame_rate_hz > 0)) header_.frame_rate_hz = 0;
  }

  const SourceText& text_;
  HeadLines lines_;
  CsvHeader header_;
  std::vector<Cells> above_;
  std::optional<std::size_t> first_row_;  // first row that is not blank or a note
};

}  // namespace

bool CsvHeader::has_rotations() const {
  return std::any_of(groups.begin(), groups.end(),
                     [](const CsvGroup& group) { return group.kind == CsvGroup::Kind::rotation; });
}

bool CsvHeader::has_no_frames() const {
  return std::any_of(notes.begin(), notes.end(),
                     [](const CsvNote& note) { return note.key == "frames" && note.value == "0"; });
}

CsvHeader read_csv_header(const SourceText& text) {
  if (starts_as_motive_export(text.bytes)) return read_motive_header(text);
  if (starts_with_vicon_section(text.bytes)) return read_vicon_header(text);
  return CsvHeaderReader(text).read();
}

bool has_csv_header(std::string_view head) {
  // Their heads may be longer than the part of the file seen here.
  if (starts_as_motive_export(head) || starts_with_vicon_section(head)) return true;
  try {
    const CsvHeader header = read_csv_header({"", head});
    return header.frame_column >= 0 || header.time_column >= 0 || header.frame_rate_hz > 0;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace kinemend
