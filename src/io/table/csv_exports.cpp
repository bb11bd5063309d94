// Reads the heads of the tables that single programs export: rows of types, names, identities,
// kinds and axes from OptiTrack Motive, and sections separated by blank lines from Vicon.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "io/table/csv_document.hpp"
#include "kinemend/extend/text.hpp"

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
      : text_(text), lines_(text, byte_order_mark_size(text.bytes)) {}

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
      header_.time_has_unit = true;
      return 1;
    }
    if (is_marker(at(types_, i)) && is_axis(i, "X") && is_axis(i + 1, "Y") && is_axis(i + 2, "Z") &&
        is_same(i, i + 1) && is_same(i, i + 2)) {
      header_.groups.push_back({CsvGroup::Kind::position, at(names_, i), {i, i + 1, i + 2, i + 2}});
      return 3;
    }
    if (!axes_[i].empty() || !at(types_, i).empty()) {
      header_.ignored.push_back({at(names_, i).empty() ? axes_[i] : at(names_, i), i});
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
  text = without_byte_order_mark(text);
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

namespace {

struct Section {
  std::string name;
  double rate_hz = 0;
  std::size_t place = 0;  ///< place of the line with its name
  std::size_t body = 0;   ///< place of the line below its rate
};

bool holds_no_cell(std::string_view line) { return line.find_first_not_of(",;\" \t") == line.npos; }

std::size_t filled(const Cells& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return !cell.empty(); }));
}

// Whether the line holds only a name: words, not a number or a note.
bool is_section_name(const Cells& cells) {
  return filled(cells) == 1 && !cells[0].empty() && cells[0][0] != '#' &&
         std::isalpha(static_cast<unsigned char>(cells[0][0])) != 0;
}

// Reads the rate from "100", or "100" and "Hz".
double section_rate(const Cells& cells) {
  if (cells.empty()) return 0;
  const std::size_t more = filled(cells) - (cells[0].empty() ? 0 : 1);
  if (more > 1 || (more == 1 && (cells.size() < 2 || !equal_ignoring_case(cells[1], "Hz"))))
    return 0;
  std::string_view number = cells[0];
  if (number.size() > 2 && equal_ignoring_case(number.substr(number.size() - 2), "Hz"))
    number = without_spaces_around(number.substr(0, number.size() - 2));
  const double rate = number_of(number);
  return rate > 0 && std::isfinite(1 / rate) ? rate : 0;
}

// Finds sections, which follow blank lines or lines of separators. Above the first one there may be
// a few lines of other facts (title, date, notes).
std::vector<Section> sections_of(const SourceText& text, bool only_first) {
  constexpr std::size_t most_lines_above = 32;
  std::vector<Section> sections;
  HeadLines lines(text, byte_order_mark_size(text.bytes));
  bool after_blank = true;
  for (std::size_t count = 0; !lines.at_end(); ++count) {
    if (only_first && count == most_lines_above) return sections;
    const std::string_view line = lines.take();
    const bool blank = holds_no_cell(line);
    const bool may_be_name = after_blank && !blank && line.size() < 256;
    after_blank = blank;
    if (!may_be_name) continue;
    Section section;
    section.place = lines.place();
    const Cells name = split_cells(line, separator_of(line));
    HeadLines below(text, lines.next());
    if (!is_section_name(name) || below.at_end()) continue;
    const std::string_view rate_line = below.take();
    section.name = name[0];
    if (rate_line.size() < 256)
      section.rate_hz = section_rate(split_cells(rate_line, separator_of(rate_line)));
    section.body = below.next();
    if (section.rate_hz > 0) {
      sections.push_back(std::move(section));
      if (only_first) return sections;
      lines = below;
    }
  }
  return sections;
}

// Whether a section has names below its rate, then axes after the frame number; only events have
// none.
bool has_table(const SourceText& text, const Section& section) {
  HeadLines lines(text, section.body);
  lines.take();
  if (lines.at_end()) return true;  // the text may be the start of a file
  const std::string_view axes = lines.take();
  return equal_ignoring_case(axes.substr(0, 5), "Frame") ||
         equal_ignoring_case(axes.substr(0, 5), "Field");
}

bool has_known_name(const Section& section) {
  constexpr std::array<std::string_view, 9> names{"Trajectories", "Model Outputs", "Devices",
                                                  "Joints",       "Segments",      "Events",
                                                  "Analog",       "Forces",        "Gaps"};
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    return equal_ignoring_case(section.name, name);
  });
}

bool is_trajectories(const Section& section) {
  return equal_ignoring_case(section.name, "Trajectories");
}

class ViconReader {
 public:
  ViconReader(const SourceText& text, const std::vector<Section>& sections, std::size_t index)
      : text_(text), section_(sections[index]), lines_(text, sections[index].body) {
    header_.data_end = index + 1 < sections.size() ? sections[index + 1].place : text.bytes.size();
  }

  CsvHeader read() {
    const Cells names = line_of_cells("names of markers");
    const Cells axes = line_of_cells("Frame, Sub Frame, X, Y, Z");
    header_.labels_line = lines_.place();
    header_.style.separator = lines_.separator();
    header_.frame_rate_hz = section_.rate_hz;
    const bool has_frames = !axes.empty() && (equal_ignoring_case(axes[0], "Frame") ||
                                              equal_ignoring_case(axes[0].substr(0, 5), "Field"));
    if (!has_frames) fail("Frame, Sub Frame, X, Y, Z");
    header_.frame_column = 0;
    group(names, axes);
    header_.data_begin = lines_.next();
    read_units();
    const std::string_view rows =
        text_.bytes.substr(header_.data_begin, header_.data_end - header_.data_begin);
    header_.style.commas = commas_of(rows, header_.style.separator);
    const std::size_t blank = header_.data_begin + first_blank_line(rows);
    refuse_text_behind(blank);
    header_.data_end = blank;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const char* wanted) const {
    throw text_.error_at(std::min(lines_.place(), text_.bytes.size()),
                         fmt::format("expected the row of {} below Trajectories", wanted));
  }

  Cells line_of_cells(const char* wanted) {
    if (lines_.next() >= header_.data_end) fail(wanted);
    return lines_.take_cells();
  }

  // A name is above its X; three columns without a name are a marker too.
  void group(const Cells& names, const Cells& axes) {
    std::vector<bool> used(axes.size());
    for (std::size_t i = 1; i + 2 < axes.size(); ++i) {
      if (!is(axes[i], 'x') || !is(axes[i + 1], 'y') || !is(axes[i + 2], 'z')) continue;
      header_.groups.push_back({CsvGroup::Kind::position,
                                i < names.size() ? names[i] : std::string(),
                                {i, i + 1, i + 2, i + 2}});
      used[i] = used[i + 1] = used[i + 2] = true;
      i += 2;
    }
    for (std::size_t i = 1; i < axes.size(); ++i) {
      if (used[i] || axes[i].empty() || equal_ignoring_case(axes[i], "Sub Frame")) continue;
      header_.ignored.push_back({axes[i], i});
    }
    if (header_.groups.empty()) fail("Frame, Sub Frame, X, Y, Z");
  }

  static bool is(const std::string& axis, char letter) {
    return axis.size() == 1 && lower_case(axis[0]) == letter;
  }

  // Reads "mm" or "(mm)" below each axis; programs before Nexus omit this row.
  void read_units() {
    if (header_.data_begin < header_.data_end) {
      HeadLines lines = lines_;
      const Cells cells = lines.take_cells();
      const bool has_numbers = std::any_of(cells.begin(), cells.end(),
                                           [](const auto& c) { return !std::isnan(number_of(c)); });
      if (!has_numbers && filled(cells) > 0) {
        header_.data_begin = lines.next();
        for (const CsvGroup& group : header_.groups) set_unit(cells, group, lines.place());
      }
    }
    if (!header_.unit.empty()) return;
    header_.unit = "mm";
    header_.unit_is_custom = true;
  }

  void set_unit(const Cells& cells, const CsvGroup& group, std::size_t place) {
    for (const std::size_t column : group.columns) {
      if (column >= cells.size()) continue;
      std::string_view unit = cells[column];
      if (unit.size() > 2 && unit.front() == '(' && unit.back() == ')')
        unit = unit.substr(1, unit.size() - 2);
      if (unit.empty()) continue;
      if (!header_.unit.empty() && header_.unit != unit)
        throw text_.error_at(place, fmt::format("expected one unit for all trajectories, found {} "
                                                "and {}",
                                                quote(header_.unit), quote(unit)));
      header_.unit = unit;
    }
  }

  static std::size_t first_blank_line(std::string_view rows) {
    for (std::size_t at = 0; at < rows.size(); at = next_line(rows, at)) {
      if (holds_no_cell(line_from(rows, at))) return at;
    }
    return rows.size();
  }

  // A blank line ends the section. Rejects rows after it, which would be lost silently.
  void refuse_text_behind(std::size_t blank) const {
    for (std::size_t at = blank; at < header_.data_end; at = next_line(text_.bytes, at)) {
      if (!holds_no_cell(line_from(text_.bytes, at)))
        throw text_.error_at(at, "expected another section after the blank line");
    }
  }

  const SourceText& text_;
  const Section& section_;
  HeadLines lines_;
  CsvHeader header_;
};

}  // namespace

bool starts_with_vicon_section(std::string_view text) {
  const SourceText source{"", text};
  const std::vector<Section> sections = sections_of(source, true);
  return !sections.empty() && (has_known_name(sections[0]) || has_table(source, sections[0]));
}

CsvHeader read_vicon_header(const SourceText& text) {
  const std::vector<Section> sections = sections_of(text, false);
  const auto found = std::find_if(sections.begin(), sections.end(), is_trajectories);
  std::vector<std::string> others;
  for (const Section& section : sections) {
    if (!is_trajectories(section)) others.push_back(section.name);
  }
  if (found == sections.end()) {
    throw text.error_at(sections.empty() ? 0 : sections[0].place,
                        fmt::format("a Vicon export of {}, without Trajectories: no markers to "
                                    "clean",
                                    quote(fmt::format("{}", fmt::join(others, ", ")))));
  }
  if (std::count_if(sections.begin(), sections.end(), is_trajectories) > 1) {
    throw text.error_at(std::find_if(found + 1, sections.end(), is_trajectories)->place,
                        "a second section Trajectories: only one can be read");
  }
  CsvHeader header =
      ViconReader(text, sections, static_cast<std::size_t>(found - sections.begin())).read();
  if (!others.empty()) header.beside = fmt::format("the sections {}", fmt::join(others, ", "));
  return header;
}

}  // namespace kinemend
