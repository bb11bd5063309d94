// Reads TSV files as takes of markers, and writes them in the layout of their source or in a plain
// one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/table/marker_table.hpp"
#include "io/table/tables.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A table of Qualisys Track Manager as it was read.
struct TsvDocument : SourceDocument, TableFile {
  std::vector<MarkerEvent> events;
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
  TsvReader(TsvDocument& document, const SourceText& text, const ReadOptions& options)
      : document_(document),
        options_(options),
        text_(text),
        lines_(text_, byte_order_mark_size(document.bytes)) {}

  Take read() {
    if (without_spaces_around(text_.bytes).empty())
      throw Error::at_line(text_.name, 1, "the file is empty");
    read_keys();
    refuse_other_tables();
    clip_.unit = "mm";
    read_rows();
    document_.events = clip_.events;
    return std::move(clip_);
  }

 private:
  struct Value {
    double number = std::nan("");
    std::size_t place = 0;
  };

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
      note_head_not_finite(text_, lines_.place(), document_.table);
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
      text_.note("event_time_not_finite", lines_.place(),
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
      text_.note("decimal_comma", table.begin, "numbers have decimal commas");
    table.zeros_are_missing = true;
    const std::size_t leading = labels_.empty() ? leading_by_width(rows) : leading_by_labels();
    for (std::size_t m = 0; m < clip_.names.size(); ++m) {
      const std::size_t x = leading + 3 * m;
      table.columns.push_back({x, x + 1, x + 2});
    }
    const auto declared = frames_.number >= 0 && frames_.number < 1e15
                              ? static_cast<std::size_t>(frames_.number)
                              : std::size_t{0};
    const TableFinding found = read_marker_table(text_, declared, document_, clip_);
    if (found.widest > 0) {
      throw text_.error_at(found.wide_row,
                           fmt::format("expected {} cells, found {}", table.width(), found.widest));
    }
    if (table.frames == 0 && frames_.number != 0) {
      throw text_.error_at(std::min(table.begin, text_.bytes.size()),
                           "expected a row for each frame, found none");
    }
    name_the_unnamed(text_, names_place_, clip_);
    check_counts();
    // FREQUENCY is a word if the cameras had an external trigger.
    finish_markers(text_, found.labels,
                   {rate_.number, rate_.place, options_.frame_rate_hz, tsv_rate_when_unknown_hz,
                    "FREQUENCY", rate_.place, "the head has no usable FREQUENCY", true},
                   document_, clip_);
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
      text_.note(kind, stated.place,
                 fmt::format("the head says {} {}, the file holds {}", stated.number, what, found));
    };
    compare(frames_, document_.table.frames, "frame_count_mismatch", "frames");
    compare(markers_, clip_.marker_count(), "marker_count_mismatch", "markers");
  }

  TsvDocument& document_;
  const ReadOptions& options_;
  const SourceText& text_;
  HeadLines lines_;
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

bool same_tsv_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const MarkerEvent& x, const MarkerEvent& y) {
                      return x.label == y.label && x.context == y.context && x.time_s == y.time_s;
                    });
}

class TsvWriter {
 public:
  explicit TsvWriter(const Take& clip) : clip_(clip), out_(32 * clip.positions.size() + 4096) {}

  std::string write() {
    write_head();
    append_marker_rows(out_, clip_, {});
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

  const Take& clip_;
  TextBuffer out_;
};

}  // namespace

std::string write_tsv(const Take& clip) {
  clip.validate();
  const auto* const document = dynamic_cast<const TsvDocument*>(clip.source.document.get());
  if (document != nullptr && same_tsv_events(clip.events, document->events)) {
    if (auto bytes = rewrite_marker_table(clip, document)) return *std::move(bytes);
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
