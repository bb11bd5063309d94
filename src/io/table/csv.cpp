// Reads CSV tables as takes of markers or joints, and writes them in the layout of their source if
// possible, else in a plain layout.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "io/motion/motion_write.hpp"
#include "io/table/csv_document.hpp"
#include "io/table/csv_joints.hpp"
#include "io/table/marker_table.hpp"
#include "io/table/tables.hpp"
#include "io/text/cells.hpp"
#include "kinemend/error.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/csv.md).
constexpr double csv_rate_when_unknown_hz = 120;

class CsvReader {
 public:
  CsvReader(CsvDocument& document, std::string_view name, const ReadOptions& options)
      : document_(document), options_(options), text_{name, document.bytes, options.strict} {}

  TakeResult read() {
    header_ = read_csv_header(text_);
    text_.bytes = text_.bytes.substr(0, header_.data_end);
    document_.beside = header_.beside;
    MarkerTable& table = document_.table;
    table.begin = header_.data_begin;
    table.style = header_.style;
    table.frame_column = header_.frame_column;
    table.time_column = header_.time_column;
    table.head_is_finite =
        std::none_of(header_.notes.begin(), header_.notes.end(),
                     [](const CsvNote& note) { return is_not_finite(note.value); });
    if (!table.head_is_finite) note("head_not_finite", header_.labels_line, head_not_finite_text);
    note_header();
    if (!header_.has_rotations()) return read_markers();
    Take clip = read_csv_joints(text_, diagnostics_, header_, document_, labels_);
    Take numbered;
    clip.frame_rate_hz = choose_rate(numbered);
    note_first_frame(clip, static_cast<double>(numbered.first_frame));
    document_.frame_rate_hz = clip.frame_rate_hz;
    return {std::move(clip), std::move(diagnostics_)};
  }

 private:
  void note(std::string_view kind, std::size_t place, std::string_view message,
            std::size_t count = 1) {
    if (count > 0) note_repair(text_, diagnostics_, kind, place, message, count);
  }

  void note_header() {
    if (header_.style.commas == CommaStyle::decimal) {
      note("decimal_comma", header_.data_begin, "numbers have decimal commas");
    }
    note("head_unknown", header_.foreign_place,
         "a line above the labels is not understood: ignored", header_.foreign_lines);
    if (!header_.ignored.empty()) {
      note("column_ignored", header_.labels_line,
           fmt::format("column {} is neither frame, time nor part of a marker or joint: ignored",
                       quote(header_.ignored[0])),
           header_.ignored.size());
    }
  }

  TakeResult read_markers() {
    Take clip;
    for (const CsvGroup& group : header_.groups) {
      if (group.kind != CsvGroup::Kind::position) continue;
      document_.table.columns.push_back({group.columns[0], group.columns[1], group.columns[2]});
      clip.names.push_back(group.label);
    }
    if (clip.names.empty()) throw text_.error_at(header_.labels_line, "the file has no markers");
    name_the_unnamed(text_, diagnostics_, header_.labels_line, clip);
    clip.unit = header_.unit;
    if (header_.unit_is_custom) {
      note(
          "unit_assumed", header_.labels_line,
          fmt::format("the export states no unit: {} assumed, the unit of its program", clip.unit));
    }
    constexpr std::size_t no_count = std::numeric_limits<std::size_t>::max();
    TableFinding rows = read_marker_table(text_, diagnostics_, no_count, document_.table, clip);
    if (rows.cut_row) document_.bytes.resize(*rows.cut_row);
    if (rows.widest > 0) {
      throw text_.error_at(rows.wide_row,
                           fmt::format("expected {} cells as in the row of labels, found more",
                                       document_.table.width()));
    }
    if (document_.table.frames == 0 && !header_.has_no_frames()) {
      throw text_.error_at(header_.data_begin, "expected a row for each frame, found none");
    }
    labels_ = std::move(rows.labels);
    if (metres_per_unit(clip.unit) == 0) {
      note("unit_unknown", header_.labels_line,
           clip.unit.empty() ? "no line '# units: mm' or the like"
                             : fmt::format("unknown unit {}", quote(clip.unit)));
    }
    clip.frame_rate_hz = choose_rate(clip);
    clip.is_position.assign(clip.marker_count(), 1);
    document_.names = clip.names;
    document_.unit = clip.unit;
    document_.first_frame = clip.first_frame;
    document_.frame_rate_hz = clip.frame_rate_hz;
    return {std::move(clip), std::move(diagnostics_)};
  }

  double choose_rate(Take& clip) {
    for (double& time : labels_.times_s) time *= header_.seconds_per_time;
    return table_rate(
        text_, diagnostics_, check_row_labels(text_, diagnostics_, document_.table, labels_, clip),
        {header_.frame_rate_hz, header_.labels_line, header_.data_begin, options_.frame_rate_hz,
         csv_rate_when_unknown_hz, "the head", header_.data_begin,
         "neither usable times nor a line '# rate_hz: 120'", false});
  }

  CsvDocument& document_;
  const ReadOptions& options_;
  SourceText text_;
  Diagnostics diagnostics_;
  CsvHeader header_;
  RowLabels labels_;
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
  quoted += '"';
  return quoted;
}

std::string number_text(double value) {
  char room[fixed_number_room];
  return {room, write_shortest(room, value)};
}

class CsvTable {
 public:
  explicit CsvTable(std::size_t expected) : out_(expected) {}

  void line(std::string_view text) {
    out_.append(text);
    out_.append("\n");
  }
  void add_labels(const std::string& name, std::initializer_list<std::string_view> parts) {
    for (const std::string_view part : parts) {
      labels_ += ',';
      labels_ += label(name, part);
    }
  }
  void write_labels() { line("frame,time_s" + labels_); }

  void begin_row(std::int64_t frame, double time_s) {
    // Microseconds. Chosen by hand.
    constexpr unsigned time_decimals = 6;
    out_.append(std::to_string(frame));
    out_.append(",");
    out_.append_fixed(time_s, time_decimals);
  }
  void add(double value) {
    out_.append(",");
    out_.append_shortest(value);
  }
  void add_coordinate(double value) {
    char room[fixed_number_room];
    out_.append(",");
    out_.append(coordinate_text(value, room, most_fixed_decimals + 1));
  }
  void add_empty(std::size_t cells) {
    for (std::size_t i = 0; i < cells; ++i) out_.append(",");
  }
  void end_row() { out_.append("\n"); }
  std::string take() && { return std::move(out_).take(); }

 private:
  std::string labels_;
  TextBuffer out_;
};

std::string write_plain_joints(const Take& clip) {
  CsvTable table(80 * clip.rotations.size() + 4096);
  table.line("# rate_hz: " + number_text(clip.frame_rate_hz));
  if (clip.frame_count() == 0) table.line("# frames: 0");
  if (clip.metres_per_unit > 0) {
    table.line("# metres_per_unit: " + number_text(clip.metres_per_unit));
  }
  const std::string skeleton = skeleton_lines(clip.skeleton);
  table.line(std::string_view(skeleton).substr(0, skeleton.size() - 1));
  const auto& names = clip.skeleton.names;
  table.add_labels("root", {"x", "y", "z"});
  for (const std::string& name : names) table.add_labels(name, {"w", "x", "y", "z"});
  for (const std::int32_t joint : clip.translated_joints)
    table.add_labels(names[static_cast<std::size_t>(joint)], {"tx", "ty", "tz"});
  table.write_labels();
  const auto add_position = [&](Vec3 v) {
    for (const double value : {v.x, v.y, v.z}) table.add(value);
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    table.begin_row(static_cast<std::int64_t>(f) + 1, static_cast<double>(f) / clip.frame_rate_hz);
    add_position(clip.root_position(f));
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Quat q = clip.rotation(f, j);
      if (!clip.is_observed(f, j)) {
        table.add_empty(4);
        continue;
      }
      for (const double value : {q.w, q.x, q.y, q.z}) table.add(value);
    }
    for (std::size_t k = 1; k < clip.point_count(); ++k) add_position(clip.position(f, k));
    table.end_row();
  }
  return std::move(table).take();
}

// Returns the document whose layout can hold the clip, or null.
const CsvDocument* kept_layout(const Take& clip) {
  const auto* const document = dynamic_cast<const CsvDocument*>(clip.source.document.get());
  const bool same = document != nullptr && document->table.head_is_finite &&
                    !document->names.empty() && clip.names == document->names &&
                    clip.unit == document->unit && clip.frame_count() == document->table.frames &&
                    clip.frame_rate_hz == document->frame_rate_hz &&
                    clip.first_frame == document->first_frame;
  return same ? document : nullptr;
}

std::string write_plain_markers(const Take& clip) {
  CsvTable table(60 * clip.positions.size() + 4096);
  table.line("# rate_hz: " + number_text(clip.frame_rate_hz));
  if (clip.frame_count() == 0) table.line("# frames: 0");
  if (!clip.unit.empty()) {
    if (clip.unit.find_first_of("\r\n") != clip.unit.npos) {
      throw Error(ErrorKind::usage, fmt::format("CSV cannot hold the unit {}", quote(clip.unit)));
    }
    table.line("# units: " + clip.unit);
  }
  for (const std::string& name : clip.names) table.add_labels(name, {"x", "y", "z"});
  table.write_labels();
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const std::int64_t frame = clip.first_frame + static_cast<std::int64_t>(f);
    table.begin_row(frame, static_cast<double>(f) / clip.frame_rate_hz);
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      if (!clip.is_observed(f, m)) {
        table.add_empty(3);
        continue;
      }
      const Vec3 v = clip.position(f, m);
      for (const double value : {v.x, v.y, v.z}) table.add_coordinate(value);
    }
    table.end_row();
  }
  return std::move(table).take();
}

}  // namespace

std::string write_csv(const Take& clip) {
  clip.validate();
  const auto* document = dynamic_cast<const CsvDocument*>(clip.source.document.get());
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
  if (const auto* const document = kept_layout(clip)) {
    if (auto bytes = rewrite_marker_table(clip, document->bytes, document->table))
      return *std::move(bytes);
  }
  if (clip.names.empty()) throw Error(ErrorKind::usage, "CSV cannot hold a clip without markers");
  return write_plain_markers(clip);
}

std::string csv_beside_markers(const Take& clip, bool as_csv) {
  if (as_csv && kept_layout(clip) != nullptr) return "";
  const SourceDocument* const document = clip.source.document.get();
  if (const auto* const table = dynamic_cast<const CsvDocument*>(document)) return table->beside;
  const auto* const rest = dynamic_cast<const TableRest*>(document);
  return rest == nullptr ? "" : rest->beside;
}

}  // namespace kinemend
