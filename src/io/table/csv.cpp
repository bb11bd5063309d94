// Reads CSV tables as takes of markers or joints, and writes them in the layout of their source if
// possible, else in a plain layout.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/motion/motion_write.hpp"
#include "io/table/csv_document.hpp"
#include "io/table/tables.hpp"
#include "kinemend/error.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/csv.md).
constexpr double csv_rate_when_unknown_hz = 120;

class CsvReader {
 public:
  CsvReader(CsvDocument& document, const SourceText& text, const ReadOptions& options)
      : document_(document), options_(options), text_(text) {}

  Take read() {
    header_ = read_csv_header(text_);
    text_.bytes = text_.bytes.substr(0, header_.data_end);
    document_.beside = header_.beside;
    MarkerTable& table = document_.table;
    table.begin = header_.data_begin;
    table.style = header_.style;
    table.frame_column = header_.frame_column;
    table.time_column = header_.time_column;
    table.labelled_columns = header_.labelled_columns;
    if (std::any_of(header_.notes.begin(), header_.notes.end(),
                    [](const CsvNote& note) { return is_not_finite(note.value); }))
      note_head_not_finite(text_, header_.labels_line, table);
    note_header();
    refuse_table_of_things();
    if (!header_.has_rotations()) return read_markers();
    RowLabels labels;
    Take clip = read_csv_joints(text_, header_, document_, labels);
    Take numbered;
    clip.frame_rate_hz = table_rate(
        text_, check_row_labels(text_, table, in_seconds(labels), numbered), table.begin, rates());
    note_first_frame(clip, static_cast<double>(numbered.first_frame));
    document_.frame_rate_hz = clip.frame_rate_hz;
    return clip;
  }

 private:
  void note_header() {
    if (header_.style.commas == CommaStyle::decimal) {
      text_.note("decimal_comma", header_.data_begin, "numbers have decimal commas");
    }
    text_.note("head_unknown", header_.foreign_place,
               "a line above the labels is not understood: ignored", header_.foreign_lines);
    if (!header_.ignored.empty()) {
      text_.note(
          "column_ignored", header_.labels_line,
          fmt::format("column {} is neither frame, time nor part of a marker or joint: ignored",
                      quote(header_.ignored[0].label)),
          header_.ignored.size());
    }
  }

  Take read_markers() {
    Take clip;
    for (const CsvGroup& group : header_.groups) {
      if (group.kind != CsvGroup::Kind::position) continue;
      document_.table.columns.push_back({group.columns[0], group.columns[1], group.columns[2]});
      clip.names.push_back(group.label);
    }
    if (clip.names.empty()) throw text_.error_at(header_.labels_line, "the file has no markers");
    name_the_unnamed(text_, header_.labels_line, clip);
    clip.unit = header_.unit;
    if (header_.unit_is_custom) {
      text_.note(
          "unit_assumed", header_.labels_line,
          fmt::format("the export states no unit: {} assumed, the unit of its program", clip.unit));
    }
    constexpr std::size_t no_count = std::numeric_limits<std::size_t>::max();
    TableFinding rows = read_marker_table(text_, no_count, document_, clip);
    if (rows.widest > 0) {
      throw text_.error_at(rows.wide_row,
                           fmt::format("expected {} cells as in the row of labels, found more",
                                       document_.table.width()));
    }
    if (document_.table.frames == 0 && !header_.has_no_frames()) {
      throw text_.error_at(header_.data_begin, "expected a row for each frame, found none");
    }
    if (metres_per_unit(clip.unit) == 0) {
      text_.note("unit_unknown", header_.labels_line,
                 clip.unit.empty() ? "no line '# units: mm' or the like"
                                   : fmt::format("unknown unit {}", quote(clip.unit)));
    }
    finish_markers(text_, in_seconds(rows.labels), rates(), document_, clip);
    return clip;
  }

  // A table without frames and times, but with a column of words, has a row for each thing (a joint
  // and its offset, a marker and its place), not for each frame.
  void refuse_table_of_things() const {
    constexpr std::size_t most_rows = 20;
    if (header_.frame_column >= 0 || header_.time_column >= 0 || header_.frame_rate_hz > 0) return;
    for (const CsvIgnored& column : header_.ignored) {
      std::size_t words = 0, rows = 0, at = header_.data_begin;
      for (; at < text_.bytes.size() && rows < most_rows; at = next_line(text_.bytes, at)) {
        const Cells cells = split_cells(line_from(text_.bytes, at), header_.style.separator);
        if (cells.size() <= column.place || cells[column.place].empty()) continue;
        ++rows;
        words += read_number(cells[column.place]).kind == TokenKind::text ? 1 : 0;
      }
      if (rows < 2 || words < rows) continue;
      throw text_.error_at(header_.labels_line,
                           fmt::format("a table with a row for each {}, not for each frame: it has "
                                       "no column of frames or times",
                                       quote(column.label)));
    }
  }

  const RowLabels& in_seconds(RowLabels& labels) const {
    const double seconds = header_.time_has_unit ? header_.seconds_per_time : unit_of(labels);
    for (double& time : labels.times_s) time *= seconds;
    return labels;
  }

  // The unit of times whose label names none: seconds, unless they are whole numbers with steps
  // that no capture has in seconds, but in milliseconds, microseconds or nanoseconds.
  double unit_of(const RowLabels& labels) const {
    const std::vector<double>& times = labels.times_s;
    const auto is_whole = [](double time) { return std::isnan(time) || time == std::floor(time); };
    if (times.size() < 3 || !std::ranges::all_of(times, is_whole)) return 1;
    const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    if (!(step > 1 / least_capture_hz)) return 1;
    struct Unit {
      double seconds;
      std::string_view name;
    };
    for (const Unit& unit :
         {Unit{1e-3, "milliseconds"}, Unit{1e-6, "microseconds"}, Unit{1e-9, "nanoseconds"}}) {
      const double rate_hz = 1 / (step * unit.seconds);
      if (rate_hz < least_capture_hz || rate_hz > most_capture_hz) continue;
      text_.note(
          "time_unit", header_.labels_line,
          fmt::format("times in whole numbers with steps of {:.4g}: read as {}", step, unit.name));
      return unit.seconds;
    }
    return 1;
  }

  TableRate rates() const {
    return {header_.frame_rate_hz,
            header_.labels_line,
            options_.frame_rate_hz,
            csv_rate_when_unknown_hz,
            "the head",
            header_.data_begin,
            "neither usable times nor a line '# rate_hz: 120'",
            false};
  }

  CsvDocument& document_;
  const ReadOptions& options_;
  SourceText text_;
  CsvHeader header_;
};

}  // namespace

int sniff_csv(std::string_view head) { return has_csv_header(head) ? 50 : 0; }

TakeResult read_csv(std::string bytes, std::string_view name, const ReadOptions& options) {
  return read_table<CsvDocument, CsvReader>(std::move(bytes), name, "csv", options);
}

namespace {

std::string label(const std::string& name, std::string_view part) {
  if (name.find_first_of("\r\n") != name.npos) {
    throw Error(ErrorKind::usage, fmt::format("CSV cannot hold the name {}", quote(name)));
  }
  std::string text = name + "_" + std::string(part);
  const bool plain = text.find_first_of(",;\t\"#") == text.npos && !is_space(text.front());
  if (plain) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

class CsvHead {
 public:
  explicit CsvHead(const Take& clip) {
    add_number("rate_hz", clip.frame_rate_hz);
    if (clip.frame_count() == 0) add("# frames: 0");
  }
  void add(std::string_view line) { text_.append(line).append("\n"); }
  void add_number(std::string_view key, double value) {
    char room[fixed_number_room];
    add(fmt::format("# {}: {}", key, std::string(room, write_shortest(room, value))));
  }
  void add_labels(const std::string& name, std::initializer_list<std::string_view> parts) {
    for (const std::string_view part : parts) labels_.append(",").append(label(name, part));
  }
  std::string text() const { return text_ + "frame,time_s" + labels_ + "\n"; }

 private:
  std::string text_, labels_;
};

std::string write_plain_joints(const Take& clip) {
  CsvHead head(clip);
  if (clip.metres_per_unit > 0) head.add_number("metres_per_unit", clip.metres_per_unit);
  const std::string skeleton = skeleton_lines(clip.skeleton);
  head.add(std::string_view(skeleton).substr(0, skeleton.size() - 1));
  const auto& names = clip.skeleton.names;
  head.add_labels("root", {"x", "y", "z"});
  for (const std::string& name : names) head.add_labels(name, {"w", "x", "y", "z"});
  for (const std::int32_t joint : clip.translated_joints)
    head.add_labels(names[static_cast<std::size_t>(joint)], {"tx", "ty", "tz"});
  TextBuffer out(80 * clip.rotations.size() + 4096);
  out.append(head.text());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    append_row_labels(out, static_cast<std::int64_t>(f) + 1,
                      static_cast<double>(f) / clip.frame_rate_hz, ',');
    const Vec3 root = clip.root_position(f);
    out.append_each(",", {root.x, root.y, root.z});
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Quat q = clip.rotation(f, j);
      if (clip.is_observed(f, j)) {
        out.append_each(",", {q.w, q.x, q.y, q.z});
      } else {
        out.append(",,,,");
      }
    }
    for (std::size_t k = 1; k < clip.point_count(); ++k) {
      const Vec3 v = clip.position(f, k);
      out.append_each(",", {v.x, v.y, v.z});
    }
    out.append("\n");
  }
  return std::move(out).take();
}

std::string write_plain_markers(const Take& clip) {
  CsvHead head(clip);
  if (!clip.unit.empty()) {
    if (clip.unit.find_first_of("\r\n") != clip.unit.npos) {
      throw Error(ErrorKind::usage, fmt::format("CSV cannot hold the unit {}", quote(clip.unit)));
    }
    head.add("# units: " + clip.unit);
  }
  for (const std::string& name : clip.names) head.add_labels(name, {"x", "y", "z"});
  TextBuffer out(60 * clip.positions.size() + 4096);
  out.append(head.text());
  append_marker_rows(out, clip, {',', "\n", most_fixed_decimals + 1, most_fixed_decimals + 1});
  return std::move(out).take();
}

const CsvDocument* csv_document_of(const Take& clip) {
  return dynamic_cast<const CsvDocument*>(clip.source.document.get());
}

}  // namespace

std::string write_csv(const Take& clip) {
  clip.validate();
  const CsvDocument* const document = csv_document_of(clip);
  const bool same_layout = document != nullptr && document->table.head_is_finite &&
                           document->skeleton.joint_count() > 0 &&
                           same_skeleton(clip.skeleton, document->skeleton) &&
                           clip.frame_count() == document->table.frames &&
                           clip.frame_rate_hz == document->frame_rate_hz &&
                           clip.metres_per_unit == document->metres_per_unit;
  if (same_layout) return rewrite_csv_joints(clip, *document);
  return write_plain_joints(clip);
}

std::string write_csv_markers(const Take& clip) {
  clip.validate();
  if (auto bytes = rewrite_marker_table(clip, csv_document_of(clip))) return *std::move(bytes);
  if (clip.names.empty()) throw Error(ErrorKind::usage, "CSV cannot hold a clip without markers");
  return write_plain_markers(clip);
}

std::string csv_beside_markers(const Take& clip, bool as_csv) {
  if (const CsvDocument* const table = csv_document_of(clip))
    return as_csv && table->fits(clip) ? "" : table->beside;
  const auto* const rest = dynamic_cast<const TableRest*>(clip.source.document.get());
  return rest == nullptr ? "" : rest->beside;
}

}  // namespace kinemend
