// Reads CSV tables as takes of markers or joints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/table/csv_document.hpp"
#include "io/table/csv_joints.hpp"
#include "io/table/read_table.hpp"
#include "io/table/tables.hpp"
#include "motion/frame_numbers.hpp"

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
    std::size_t unnamed = 0;
    for (const CsvGroup& group : header_.groups) {
      if (group.kind != CsvGroup::Kind::position) continue;
      document_.table.columns.push_back({group.columns[0], group.columns[1], group.columns[2]});
      clip.names.push_back(group.label);
      if (!group.label.empty()) continue;
      clip.names.back() = fmt::format("*{}", clip.names.size());
      ++unnamed;
    }
    if (clip.names.empty()) throw text_.error_at(header_.labels_line, "the file has no markers");
    note("marker_unnamed", header_.labels_line,
         "a marker has no name: it is called *1, *2, ... by its position", unnamed);
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

}  // namespace kinemend
