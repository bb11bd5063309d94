// Reads TRC files as takes of markers, with their heads in all dialects, and writes them in the
// layout of their source or in a plain one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/table/marker_table.hpp"
#include "io/table/tables.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

/// The lines above the rows of a TRC file.
struct TrcHeader {
  std::string_view first_line;  ///< `PathFileType ...`; empty if missing
  std::string first_cell;       ///< the name in the first line
  std::vector<std::string> keys;
  std::vector<std::string> values;
  std::size_t values_line = 0;  ///< byte of the line of values
  std::size_t labels_line = 0;
  std::vector<std::string> labels;  ///< after `Frame#` and `Time`, one per marker
  bool has_time = true;
  CellStyle style;  ///< style of the rows
  std::size_t data_begin = 0;

  /// Returns the value of a key; empty if the header lacks it.
  std::string_view value(std::string_view key) const;
  /// Returns the value of a key as a number; NaN if it is not finite. A decimal comma is allowed.
  double number(std::string_view key) const;
};

/// A number of the head that the rows contradict. It is mended in a file that is changed anyway.
struct TrcFault {
  std::string key;  ///< as in the line of keys
  std::string right;
};

/// A TRC file as it was read.
struct TrcDocument : SourceDocument, TableFile {
  std::string first_line;
  std::size_t values_line = 0;  ///< byte of the line of values
  std::vector<std::string> keys;
  std::vector<TrcFault> faults;
};

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
  explicit TrcHeaderReader(const SourceText& text)
      : text_(text), lines_(text, byte_order_mark_size(text.bytes)) {}

  TrcHeader read() {
    if (is_empty(text_.bytes)) throw Error::at_line(text_.name, 1, "the file is empty");
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

  void read_line() {
    if (lines_.at_end()) {
      throw text_.error_at(lines_.next(),
                           "expected the row of labels (Frame#, Time, names of markers), "
                           "found the end of the file");
    }
    const std::string_view line = lines_.take();
    if (is_empty(line)) return;
    if (static_cast<std::size_t>(std::count_if(line.begin(), line.end(), is_filler)) >
        6 * most_markers) {
      throw text_.error_at(lines_.place(),
                           fmt::format("at most {} markers can be read", most_markers));
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
      const std::string_view values = lines_.take();
      header_.values = without_empty(split_cells(values, separator_in(values)));
      header_.values_line = lines_.place();
    } else if (begins_with(cells[0], "Frame")) {
      labels_separator_ = separator_in(line);
      read_labels(cells, labels_separator_);
    } else {
      throw text_.error_at(
          lines_.place(),
          fmt::format("expected {}, found {}",
                      header_.first_line.empty() && header_.keys.empty() ? "PathFileType"
                      : header_.keys.empty() ? "DataRate and the other keys"
                                             : "Frame#, Time and names of markers",
                      quote(line)));
    }
  }

  void read_labels(std::vector<std::string> cells, char separator) {
    header_.labels_line = lines_.place();
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
      text_.note("label_layout", lines_.place(),
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
    header_.data_begin = lines_.next();
    while (!lines_.at_end()) {
      const std::string_view line = lines_.take();
      const std::size_t first = line.find_first_not_of(" \t\v\f\",;");
      if (first == line.npos) {
        has_blank = true;
      } else if (std::string_view("XYZxyz").find(line[first]) != std::string_view::npos &&
                 !has_axes) {
        has_axes = true;
      } else {
        header_.data_begin = lines_.place();
        break;
      }
      header_.data_begin = lines_.next();
    }
    if (!has_axes && !header_.labels.empty()) {
      text_.note("axis_row_missing", header_.labels_line, "the row of X1, Y1, Z1 is missing");
    }
    if (!has_blank) {
      text_.note("blank_row_missing", header_.data_begin,
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
    refuse_commas_of_two_kinds(rows);
    header_.style.commas = commas_of(rows, separator);
    if (header_.style.commas == CommaStyle::none) return;
    text_.note("decimal_comma", header_.data_begin, "numbers have decimal commas");
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
    text_.note(
        spaces ? "space_separator" : "comma_separator", header_.data_begin,
        fmt::format("{} separate the cells instead of tabs", spaces             ? "spaces"
                                                             : separator == ',' ? "commas"
                                                                                : "semicolons"));
  }

  const SourceText& text_;
  HeadLines lines_;
  TrcHeader header_;
  char head_separator_ = 0;  // separator of the first line
  char labels_separator_ = '\t';
};

}  // namespace

std::string_view TrcHeader::value(std::string_view key) const {
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
    if (equal_ignoring_case(keys[i], key)) return values[i];
  }
  return {};
}

double TrcHeader::number(std::string_view key) const {
  const NumberToken token = read_number(value(key), CommaStyle::decimal);
  return token.kind == TokenKind::number ? token.value : not_a_number;
}

namespace {

// Chosen by hand (docs/formats/trc.md).
constexpr double trc_rate_when_unknown_hz = 100;

std::string rate_text(double rate_hz) {
  char room[fixed_number_room];
  const std::string two_decimals(room, write_fixed(room, rate_hz, 2));
  const NumberToken token = read_number(two_decimals);
  return token.value == rate_hz ? two_decimals : std::string(room, write_shortest(room, rate_hz));
}

std::size_t whole(double number) {
  constexpr double most = 1e15;
  return number >= 0 && number <= most ? static_cast<std::size_t>(number) : 0;
}

class TrcReader {
 public:
  TrcReader(TrcDocument& document, const SourceText& text, const ReadOptions& options)
      : document_(document), options_(options), text_(text) {}

  Take read() {
    header_ = TrcHeaderReader(text_).read();
    clip_.names = header_.labels;
    MarkerTable& table = document_.table;
    table.begin = header_.data_begin;
    table.style = header_.style;
    table.frame_column = 0;
    table.time_column = header_.has_time ? 1 : -1;
    clip_.unit = header_.value("Units");
    if (is_not_finite(clip_.unit)) clip_.unit.clear();
    if (std::any_of(header_.values.begin(), header_.values.end(), is_not_finite))
      note_head_not_finite(text_, header_.values_line, table);
    const TableFinding rows = read_rows();
    name_the_unnamed(text_, header_.labels_line, clip_);
    check_counts();
    finish_markers(text_, rows.labels,
                   {header_.number("DataRate"), header_.values_line, options_.frame_rate_hz,
                    trc_rate_when_unknown_hz, "DataRate", header_.values_line,
                    "the header has no usable DataRate", true},
                   document_, clip_);
    note_facts();
    const double stated_hz = header_.number("DataRate");
    if (is_usable_frame_rate(stated_hz) && stated_hz != clip_.frame_rate_hz)
      document_.faults.push_back({"DataRate", rate_text(clip_.frame_rate_hz)});
    document_.values_line = header_.values_line;
    document_.keys = header_.keys;
    document_.first_line = header_.first_line;
    return std::move(clip_);
  }

 private:
  std::size_t leading_columns() const { return header_.has_time ? 2 : 1; }

  TableFinding read_rows() {
    set_columns();
    const auto declared = whole(header_.number("NumFrames"));
    TableFinding rows = read_marker_table(text_, declared, document_, clip_);
    if (rows.widest == 0) return rows;
    // The commas may be both separators and decimal.
    if (document_.table.style.separator == ',') {
      throw text_.error_at(rows.wide_row,
                           fmt::format("expected {} cells between commas as in the row of labels, "
                                       "found {}",
                                       document_.table.width(), rows.widest));
    }
    // Coordinates beyond the labels are markers without a name.
    const std::size_t markers = (rows.widest - leading_columns() + 2) / 3;
    check_marker_count(markers);
    clip_.names.resize(markers);
    set_columns();
    return read_marker_table(text_, declared, document_, clip_);
  }

  void check_marker_count(std::size_t markers) const {
    if (markers <= most_markers) return;
    throw text_.error_at(header_.labels_line,
                         fmt::format("{} markers: at most {} can be read", markers, most_markers));
  }

  void set_columns() {
    auto& columns = document_.table.columns;
    columns.clear();
    for (std::size_t m = 0; m < clip_.names.size(); ++m) {
      const std::size_t x = leading_columns() + 3 * m;
      columns.push_back({x, x + 1, x + 2});
    }
  }

  void check_counts() {
    if (clip_.names.empty()) throw text_.error_at(header_.labels_line, "the file has no markers");
    // A take without frames must state NumFrames 0.
    if (document_.table.frames == 0 && header_.number("NumFrames") != 0) {
      throw text_.error_at(header_.data_begin, "expected a row for each frame, found none");
    }
    const auto compare = [&](std::string_view key, std::size_t found, std::string_view kind,
                             std::string_view what) {
      if (header_.number(key) == static_cast<double>(found)) return;
      const std::string_view says = header_.value(key);
      document_.faults.push_back({std::string(key), std::to_string(found)});
      text_.note(kind, header_.values_line,
                 fmt::format("{} says {}, the file holds {} {}", key,
                             says.empty() ? "nothing" : quote(says), found, what));
    };
    compare("NumFrames", document_.table.frames, "frame_count_mismatch", "frames");
    compare("NumMarkers", clip_.marker_count(), "marker_count_mismatch", "markers");
    if (header_.first_line.empty()) {
      text_.note("header_line_missing", std::size_t{0}, "the line PathFileType is missing");
    }
    if (metres_per_unit(clip_.unit) == 0) {
      text_.note("unit_unknown", header_.values_line,
                 clip_.unit.empty() ? "the file names no unit"
                                    : fmt::format("unknown unit {}", quote(clip_.unit)));
    }
  }

  void note_facts() {
    const auto add = [&](std::string_view name, std::string_view key, double usual,
                         std::string_view unit) {
      const double number = header_.number(key);
      if (std::isnan(number) || number == usual) return;
      clip_.source.facts.push_back({std::string(name), fmt::format("{}{}", number, unit)});
    };
    if (!header_.first_cell.empty()) {
      clip_.source.facts.push_back({"name in the file", header_.first_cell});
    }
    add("camera rate", "CameraRate", clip_.frame_rate_hz, " Hz");
    add("original rate", "OrigDataRate", clip_.frame_rate_hz, " Hz");
    add("original frames", "OrigNumFrames", static_cast<double>(document_.table.frames), "");
  }

  TrcDocument& document_;
  const ReadOptions& options_;
  const SourceText& text_;
  TrcHeader header_;
  Take clip_;
};

}  // namespace

int sniff_trc(std::string_view head) {
  head = without_byte_order_mark(head);
  if (head.substr(0, 1) == "\"") head.remove_prefix(1);
  constexpr std::string_view word = "PathFileType";
  const std::string_view start = TextScanner(head, 0).next().substr(0, word.size());
  const std::size_t end = head.find(start) + start.size();
  const bool ends = end == head.size() ||
                    std::string_view(" \t,;\"\r\n").find(head[end]) != std::string_view::npos;
  return equal_ignoring_case(start, word) && ends ? 100 : 0;
}

TakeResult read_trc(std::string bytes, std::string_view name, const ReadOptions& options) {
  return read_table<TrcDocument, TrcReader>(std::move(bytes), name, "trc", options);
}

namespace {

// Returns the first line of the source, for a clip whose frames or markers differ.
std::string first_line_of(const Take& clip, const TrcDocument* document) {
  // A first line with commas does not fit a table with tabs.
  if (document != nullptr && !document->first_line.empty() &&
      (document->first_line.find('\t') != std::string::npos ||
       document->first_line.find_first_of(",;") == std::string::npos)) {
    return document->first_line;
  }
  std::string name = std::filesystem::path(clip.source.name).filename().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\t' || is_line_end(c); }, ' ');
  return "PathFileType\t4\t(X/Y/Z)\t" + (name.empty() ? "kinemend.trc" : name);
}

// Returns the line end and the decimals of the source.
TableStyle style_of(const TrcDocument* document) {
  TableStyle style;
  if (document == nullptr) return style;
  if (line_ending_of(document->bytes) == "\r\n") style.line_end = "\r\n";
  style.decimals = decimals_of(*document);
  return style;
}

class TrcWriter {
 public:
  TrcWriter(const Take& clip, const TrcDocument* document)
      : clip_(clip), style_(style_of(document)), out_(64 * clip.positions.size() + 4096) {
    write_header(first_line_of(clip, document));
  }

  std::string write() {
    append_marker_rows(out_, clip_, style_);
    return std::move(out_).take();
  }

 private:
  void line(std::string_view text) {
    out_.append(text);
    out_.append(style_.line_end);
  }

  void write_header(const std::string& first_line) {
    const std::string rate = rate_text(clip_.frame_rate_hz);
    line(first_line);
    line(
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
        "OrigNumFrames");
    line(fmt::format("{0}\t{0}\t{1}\t{2}\t{3}\t{0}\t{4}\t{1}", rate, clip_.frame_count(),
                     clip_.marker_count(), clip_.unit.empty() ? "mm" : clip_.unit,
                     clip_.first_frame));
    std::string names = "Frame#\tTime", axes = "\t";
    for (std::size_t m = 0; m < clip_.marker_count(); ++m) {
      if (clip_.names[m].find_first_of("\r\n") != std::string::npos) {
        throw Error(ErrorKind::usage,
                    fmt::format("TRC cannot hold the name {}", quote(clip_.names[m])));
      }
      names.append(m == 0 ? "\t" : "\t\t\t").append(cell_of(clip_.names[m], '\t'));
      axes += fmt::format("\tX{0}\tY{0}\tZ{0}", m + 1);
    }
    line(names + "\t\t");
    line(axes);
    line("");
  }

  const Take& clip_;
  TableStyle style_;
  TextBuffer out_;
};

}  // namespace

namespace {

// Replaces the values of the head that the rows contradict, with the separators as they are.
std::string with_right_head(std::string bytes, const TrcDocument& document) {
  for (const TrcFault& fault : document.faults) {
    const auto key = std::ranges::find_if(
        document.keys, [&](const std::string& own) { return equal_ignoring_case(own, fault.key); });
    const std::string_view line = line_from(bytes, document.values_line);
    std::size_t left = static_cast<std::size_t>(key - document.keys.begin());
    const std::string_view separators = line.find('\t') != line.npos  ? "\t"
                                        : line.find(',') != line.npos ? ","
                                                                      : " ";
    std::size_t begin = line.find_first_not_of(separators);
    for (; left > 0 && begin < line.size(); --left)
      begin = line.find_first_not_of(separators, line.find_first_of(separators, begin));
    if (key == document.keys.end() || begin >= line.size()) continue;
    const std::size_t end = std::min(line.size(), line.find_first_of(separators, begin));
    bytes.replace(document.values_line + begin, end - begin, fault.right);
  }
  return bytes;
}

}  // namespace

std::string write_trc(const Take& clip) {
  clip.validate();
  const auto* document = dynamic_cast<const TrcDocument*>(clip.source.document.get());
  if (auto bytes = rewrite_marker_table(clip, document)) {
    if (*bytes == document->bytes) return *std::move(bytes);
    return with_right_head(*std::move(bytes), *document);
  }
  if (clip.names.empty()) throw Error(ErrorKind::usage, "TRC cannot hold a clip without markers");
  return TrcWriter(clip, document).write();
}

}  // namespace kinemend
