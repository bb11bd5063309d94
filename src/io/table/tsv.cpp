// Reads TSV files as takes of markers, and writes them in the layout of their source or in a plain
// one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/table/csv_document.hpp"
#include "io/table/marker_table.hpp"
#include "io/table/tables.hpp"
#include "io/text/cells.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A table of Qualisys Track Manager as it was read: the bytes hold every digit.
struct TsvDocument : SourceDocument {
  std::string bytes;
  MarkerTable table;
  std::vector<std::string> names;
  std::vector<MarkerEvent> events;
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;
  std::string unit;
};

namespace {

// Chosen by hand (docs/formats/tsv.md).
constexpr double tsv_rate_when_unknown_hz = 100;

// Whether a cell is a key, such as NO_OF_FRAMES.
bool is_key(std::string_view cell) {
  const auto fits = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return cell.size() > 2 && cell[0] >= 'A' && cell[0] <= 'Z' &&
         std::all_of(cell.begin(), cell.end(), fits);
}

class TsvReader {
 public:
  TsvReader(TsvDocument& document, std::string_view name, const ReadOptions& options)
      : document_(document),
        options_(options),
        text_{name, document.bytes, options.strict},
        lines_(text_, byte_order_mark_size(document.bytes)) {}

  TakeResult read() {
    if (without_spaces_around(text_.bytes).empty())
      throw Error::at_line(text_.name, 1, "the file is empty");
    read_keys();
    refuse_other_tables();
    read_rows();
    clip_.unit = "mm";
    clip_.is_position.assign(clip_.marker_count(), 1);
    document_.names = clip_.names;
    document_.events = clip_.events;
    document_.frame_rate_hz = clip_.frame_rate_hz;
    document_.first_frame = clip_.first_frame;
    document_.unit = clip_.unit;
    return {std::move(clip_), std::move(diagnostics_)};
  }

 private:
  struct Value {
    double number = std::nan("");
    std::size_t place = 0;
  };

  void note(std::string_view kind, std::size_t place, std::string_view message,
            std::size_t count = 1) {
    if (count > 0) note_repair(text_, diagnostics_, kind, place, message, count);
  }

  // Reads keys up to the first line without a key, which may be a row of labels.
  void read_keys() {
    for (;;) {
      const std::size_t begin = lines_.next();
      if (lines_.at_end()) break;
      if (without_spaces_around(line_from(text_.bytes, begin)).empty()) {
        lines_.take();
        continue;
      }
      Cells cells = lines_.take_cells();
      if (!is_key(cells[0])) {
        document_.table.begin = begin;
        if (equal_ignoring_case(cells[0], "Frame")) labels_ = std::move(cells);
        if (!labels_.empty()) document_.table.begin = lines_.next();
        return;
      }
      read_key(cells);
    }
    document_.table.begin = text_.bytes.size();
  }

  void read_key(Cells& cells) {
    const std::string key = cells[0];
    const std::string value = cells.size() > 1 ? cells[1] : "";
    const bool is_number =
        key != "MARKER_NAMES" && key != "DESCRIPTION" && key != "TRAJECTORY_TYPES";
    if (is_number && std::any_of(cells.begin(), cells.end(), is_not_finite)) {
      document_.table.head_is_finite = false;
      note("head_not_finite", lines_.place(), head_not_finite_text);
    }
    if (key == "NO_OF_FRAMES") frames_ = {number_of(value), lines_.place()};
    if (key == "NO_OF_MARKERS") markers_ = {number_of(value), lines_.place()};
    if (key == "FREQUENCY") rate_ = {number_of(value), lines_.place()};
    if (key == "DATA_INCLUDED") included_ = value;
    if (key == "EVENT" && cells.size() > 3) read_event(cells);
    if (key == "MARKER_NAMES") {
      names_place_ = lines_.place();
      cells.erase(cells.begin());
      while (!cells.empty() && cells.back().empty()) cells.pop_back();
      clip_.names = std::move(cells);
    }
  }

  // Reads an event: its name, its frame, its time.
  void read_event(const Cells& cells) {
    const double time_s = number_of(cells[3]);
    if (std::isfinite(time_s)) {
      clip_.events.push_back({cells[1], "", time_s});
    } else {
      note("event_time_not_finite", lines_.place(),
           "the time of an event is not finite: the event is left out");
    }
  }

  void refuse_other_tables() const {
    const bool is_3d = included_.empty() || equal_ignoring_case(included_, "3D");
    if (is_3d && !clip_.names.empty()) return;
    throw text_.error_at(std::size_t{0},
                         fmt::format("a Qualisys table{}{}: no markers to clean",
                                     is_3d ? "" : fmt::format(" of {} data", quote(included_)),
                                     clip_.names.empty() ? " without MARKER_NAMES" : ""));
  }

  void read_rows() {
    MarkerTable& table = document_.table;
    const std::string_view rows = text_.bytes.substr(table.begin);
    table.style.separator = '\t';
    table.style.commas = rows.find(',') != rows.npos ? CommaStyle::decimal : CommaStyle::none;
    if (table.style.commas == CommaStyle::decimal)
      note("decimal_comma", table.begin, "numbers have decimal commas");
    table.zeros_are_missing = true;
    const std::size_t leading = labels_.empty() ? leading_by_width(rows) : leading_by_labels();
    for (std::size_t m = 0; m < clip_.names.size(); ++m) {
      const std::size_t x = leading + 3 * m;
      table.columns.push_back({x, x + 1, x + 2});
    }
    const auto declared = frames_.number >= 0 && frames_.number < 1e15
                              ? static_cast<std::size_t>(frames_.number)
                              : std::size_t{0};
    const TableFinding found = read_marker_table(text_, diagnostics_, declared, table, clip_);
    if (found.cut_row) document_.bytes.resize(*found.cut_row);
    if (found.widest > 0) {
      throw text_.error_at(found.wide_row,
                           fmt::format("expected {} cells, found {}", table.width(), found.widest));
    }
    if (table.frames == 0 && frames_.number != 0) {
      throw text_.error_at(std::min(table.begin, text_.bytes.size()),
                           "expected a row for each frame, found none");
    }
    name_the_unnamed(text_, diagnostics_, names_place_, clip_);
    check_counts();
    // FREQUENCY is a word if the cameras had an external trigger.
    clip_.frame_rate_hz = table_rate(
        text_, diagnostics_, check_row_labels(text_, diagnostics_, table, found.labels, clip_),
        {rate_.number, rate_.place, table.begin, options_.frame_rate_hz, tsv_rate_when_unknown_hz,
         "FREQUENCY", rate_.place, "the head has no usable FREQUENCY", true});
  }

  // Counts the labels before the markers: `Frame`, `Time`, then three labels per marker.
  std::size_t leading_by_labels() {
    std::size_t leading = 0;
    while (leading < labels_.size() && !ends_with_axis(labels_[leading])) ++leading;
    while (!labels_.empty() && labels_.back().empty()) labels_.pop_back();
    if (labels_.size() != leading + 3 * clip_.names.size()) {
      throw text_.error_at(lines_.place(),
                           fmt::format("expected labels of {} markers as in MARKER_NAMES, found {} "
                                       "cells",
                                       clip_.names.size(), labels_.size()));
    }
    for (std::size_t i = 0; i < leading; ++i) {
      const auto column = static_cast<std::int32_t>(i);
      if (i == 0) {
        document_.table.frame_column = column;
      } else if (equal_ignoring_case(labels_[i], "Time")) {
        document_.table.time_column = column;
      } else {
        document_.table.style.mark_text(i);
      }
    }
    return leading;
  }

  static bool ends_with_axis(const std::string& label) {
    return label.size() > 2 && label[label.size() - 2] == ' ' &&
           std::string_view("XYZ").find(label.back()) != std::string_view::npos;
  }

  // Either both frame and time precede the markers, or neither.
  std::size_t leading_by_width(std::string_view rows) {
    const std::size_t cells = split_cells(line_from(rows, 0), '\t').size();
    if (cells <= 3 * clip_.names.size()) return 0;
    document_.table.frame_column = 0;
    document_.table.time_column = 1;
    return 2;
  }

  void check_counts() {
    const auto compare = [&](const Value& stated, std::size_t found, std::string_view kind,
                             std::string_view what) {
      if (std::isnan(stated.number) || stated.number == static_cast<double>(found)) return;
      note(kind, stated.place,
           fmt::format("the head says {} {}, the file holds {}", stated.number, what, found));
    };
    compare(frames_, document_.table.frames, "frame_count_mismatch", "frames");
    compare(markers_, clip_.marker_count(), "marker_count_mismatch", "markers");
  }

  TsvDocument& document_;
  const ReadOptions& options_;
  SourceText text_;
  HeadLines lines_;
  Diagnostics diagnostics_;
  Take clip_;
  Cells labels_;
  Value frames_, markers_, rate_;
  std::string included_;
  std::size_t names_place_ = 0;
};

}  // namespace

int sniff_tsv(std::string_view head) {
  head = without_byte_order_mark(head);
  const std::string_view line = line_from(head, 0);
  const std::string_view key = line.substr(0, line.find('\t'));
  for (const std::string_view known :
       {"FILE_VERSION", "NO_OF_FRAMES", "NO_OF_CAMERAS", "NO_OF_MARKERS", "NO_OF_BODIES",
        "TOT_NO_OF_CHAN", "NO_OF_SAMPLES", "NO_OF_FORCE_PLATES"}) {
    if (key == known) return 90;
  }
  return 0;
}

TakeResult read_tsv(std::string bytes, std::string_view name, const ReadOptions& options) {
  return read_table<TsvDocument, TsvReader>(std::move(bytes), name, "tsv", options);
}

namespace {

bool keeps_layout(const Take& clip, const TsvDocument& document) {
  const auto same_event = [](const MarkerEvent& a, const MarkerEvent& b) {
    return a.label == b.label && a.context == b.context && a.time_s == b.time_s;
  };
  return document.table.head_is_finite && clip.names == document.names &&
         clip.unit == document.unit && clip.frame_count() == document.table.frames &&
         clip.frame_rate_hz == document.frame_rate_hz && clip.first_frame == document.first_frame &&
         std::equal(clip.events.begin(), clip.events.end(), document.events.begin(),
                    document.events.end(), same_event);
}

class TsvWriter {
 public:
  explicit TsvWriter(const Take& clip) : clip_(clip), out_(32 * clip.positions.size() + 4096) {}

  std::string write() {
    write_head();
    for (std::size_t f = 0; f < clip_.frame_count(); ++f) write_row(f);
    return std::move(out_).take();
  }

 private:
  void line(const std::string& key, const std::string& value) {
    out_.append(key + "\t" + value + "\n");
  }

  static std::string cell(std::string_view text) {
    if (text.find_first_of("\r\n") != text.npos)
      throw Error(ErrorKind::usage, fmt::format("TSV cannot hold the name {}", quote(text)));
    return cell_of(text, '\t');
  }

  void write_head() {
    char room[fixed_number_room];
    line("NO_OF_FRAMES", std::to_string(clip_.frame_count()));
    line("NO_OF_CAMERAS", "0");
    line("NO_OF_MARKERS", std::to_string(clip_.marker_count()));
    line("FREQUENCY", std::string(room, write_shortest(room, clip_.frame_rate_hz)));
    line("NO_OF_ANALOG", "0");
    line("ANALOG_FREQUENCY", "0");
    line("DESCRIPTION", "--");
    line("TIME_STAMP", "--");
    line("DATA_INCLUDED", "3D");
    for (const MarkerEvent& event : clip_.events) {
      const std::string name =
          event.context.empty() ? event.label : event.context + " " + event.label;
      const std::string time(room, write_shortest(room, event.time_s));
      line("EVENT",
           fmt::format("{}\t{:.0f}\t{}", cell(name), 1 + event.time_s * clip_.frame_rate_hz, time));
    }
    std::string names, types, labels;
    for (const std::string& name : clip_.names) {
      const bool first = names.empty() && types.empty();
      names.append(first ? "" : "\t").append(cell(name));
      types += first ? "Measured" : "\tMeasured";
      for (const char* axis : {" X", " Y", " Z"}) labels.append("\t").append(cell(name + axis));
    }
    line("MARKER_NAMES", names);
    line("TRAJECTORY_TYPES", types);
    out_.append("Frame\tTime" + labels + "\n");
  }

  void write_row(std::size_t frame) {
    // Microseconds. Chosen by hand.
    constexpr unsigned time_decimals = 6;
    out_.append(std::to_string(clip_.first_frame + static_cast<std::int64_t>(frame)));
    out_.append("\t");
    out_.append_fixed(static_cast<double>(frame) / clip_.frame_rate_hz, time_decimals);
    char room[fixed_number_room];
    for (std::size_t m = 0; m < clip_.marker_count(); ++m) {
      const Vec3 position = clip_.position(frame, m);
      for (const double value : {position.x, position.y, position.z}) {
        out_.append("\t");
        if (clip_.is_observed(frame, m))
          out_.append(coordinate_text(value, room, most_fixed_decimals));
      }
    }
    out_.append("\n");
  }

  const Take& clip_;
  TextBuffer out_;
};

}  // namespace

std::string write_tsv(const Take& clip) {
  clip.validate();
  const auto* const document = dynamic_cast<const TsvDocument*>(clip.source.document.get());
  if (document != nullptr && keeps_layout(clip, *document)) {
    if (auto bytes = rewrite_marker_table(clip, document->bytes, document->table))
      return *std::move(bytes);
  }
  if (clip.names.empty()) throw Error(ErrorKind::usage, "TSV cannot hold a clip without markers");
  constexpr double millimetre = 0.001;
  if (const double unit = metres_per_unit(clip.unit); unit > 0 && unit != millimetre) {
    throw Error(ErrorKind::usage,
                fmt::format("TSV files are in millimetres, the take is in {}", quote(clip.unit)));
  }
  return TsvWriter(clip).write();
}

}  // namespace kinemend
