// Reads TRC files as takes of markers, and writes them in the layout of their source or in a plain
// one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "io/table/marker_table.hpp"
#include "io/table/tables.hpp"
#include "io/table/trc_document.hpp"
#include "io/text/cells.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/trc.md).
constexpr double trc_rate_when_unknown_hz = 100;

std::size_t whole(double number) {
  constexpr double most = 1e15;
  return number >= 0 && number <= most ? static_cast<std::size_t>(number) : 0;
}

class TrcReader {
 public:
  TrcReader(TrcDocument& document, std::string_view name, const ReadOptions& options)
      : document_(document), options_(options), text_{name, document.bytes, options.strict} {}

  TakeResult read() {
    header_ = read_trc_header(text_, diagnostics_);
    clip_.names = header_.labels;
    MarkerTable& table = document_.table;
    table.begin = header_.data_begin;
    table.style = header_.style;
    table.frame_column = 0;
    table.time_column = header_.has_time ? 1 : -1;
    clip_.unit = header_.value("Units");
    if (is_not_finite(clip_.unit)) clip_.unit.clear();
    table.head_is_finite =
        std::none_of(header_.values.begin(), header_.values.end(), is_not_finite);
    if (!table.head_is_finite)
      note_repair(text_, diagnostics_, "head_not_finite", header_.values_line,
                  head_not_finite_text);
    const TableFinding rows = read_rows();
    if (rows.cut_row) document_.bytes.resize(*rows.cut_row);
    name_the_unnamed(text_, diagnostics_, header_.labels_line, clip_);
    check_counts();
    clip_.frame_rate_hz = table_rate(
        text_, diagnostics_, check_row_labels(text_, diagnostics_, table, rows.labels, clip_),
        {header_.number("DataRate"), header_.values_line, table.begin, options_.frame_rate_hz,
         trc_rate_when_unknown_hz, "DataRate", header_.values_line,
         "the header has no usable DataRate", true});
    clip_.is_position.assign(clip_.marker_count(), 1);
    note_facts();
    return finish();
  }

 private:
  std::size_t leading_columns() const { return header_.has_time ? 2 : 1; }

  TableFinding read_rows() {
    set_columns();
    const auto declared = whole(header_.number("NumFrames"));
    TableFinding rows = read_marker_table(text_, diagnostics_, declared, document_.table, clip_);
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
    return read_marker_table(text_, diagnostics_, declared, document_.table, clip_);
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
      note_repair(text_, diagnostics_, kind, header_.values_line,
                  fmt::format("{} says {}, the file holds {} {}", key,
                              says.empty() ? "nothing" : quote(says), found, what));
    };
    compare("NumFrames", document_.table.frames, "frame_count_mismatch", "frames");
    compare("NumMarkers", clip_.marker_count(), "marker_count_mismatch", "markers");
    if (header_.first_line.empty()) {
      note_repair(text_, diagnostics_, "header_line_missing", 0,
                  "the line PathFileType is missing");
    }
    if (metres_per_unit(clip_.unit) == 0) {
      note_repair(text_, diagnostics_, "unit_unknown", header_.values_line,
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

  TakeResult finish() {
    document_.first_line = header_.first_line;
    document_.names = clip_.names;
    document_.frame_rate_hz = clip_.frame_rate_hz;
    document_.first_frame = clip_.first_frame;
    document_.unit = clip_.unit;
    return {std::move(clip_), std::move(diagnostics_)};
  }

  TrcDocument& document_;
  const ReadOptions& options_;
  SourceText text_;
  Diagnostics diagnostics_;
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

// The style of a file that does not use its source's layout.
struct PlainStyle {
  std::string first_line;
  std::string_view line_end = "\n";
  unsigned decimals = 10;  // more than nine: as many digits as a value needs
};

// Returns the first line and the decimals of the source, for a clip whose frames or markers differ.
PlainStyle style_of(const Take& clip, const TrcDocument* document) {
  PlainStyle style;
  if (document != nullptr) {
    // A first line with commas does not fit a table with tabs.
    if (document->first_line.find('\t') != std::string::npos ||
        document->first_line.find_first_of(",;") == std::string::npos) {
      style.first_line = document->first_line;
    }
    const std::size_t end = document->bytes.find_first_of("\r\n");
    if (end != std::string::npos) {
      style.line_end = document->bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\n";
    }
    style.decimals = decimals_of(document->bytes, document->table);
  }
  if (style.first_line.empty()) {
    std::string name = std::filesystem::path(clip.source.name).filename().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\t' || is_line_end(c); }, ' ');
    style.first_line = "PathFileType\t4\t(X/Y/Z)\t" + (name.empty() ? "kinemend.trc" : name);
  }
  return style;
}

std::string rate_text(double rate_hz) {
  char room[fixed_number_room];
  const std::string two_decimals(room, write_fixed(room, rate_hz, 2));
  const NumberToken token =
      read_number(two_decimals.data(), two_decimals.data() + two_decimals.size());
  return token.value == rate_hz ? two_decimals : std::string(room, write_shortest(room, rate_hz));
}

class TrcWriter {
 public:
  TrcWriter(const Take& clip, PlainStyle style)
      : clip_(clip), style_(std::move(style)), out_(64 * clip.positions.size() + 4096) {}

  std::string write() {
    write_header();
    for (std::size_t f = 0; f < clip_.frame_count(); ++f) write_row(f);
    return std::move(out_).take();
  }

 private:
  void line(std::string_view text) {
    out_.append(text);
    out_.append(style_.line_end);
  }

  void write_header() {
    const std::string rate = rate_text(clip_.frame_rate_hz);
    line(style_.first_line);
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

  void write_row(std::size_t frame) {
    // Microseconds. Chosen by hand.
    constexpr unsigned time_decimals = 6;
    out_.append(std::to_string(clip_.first_frame + static_cast<std::int64_t>(frame)));
    out_.append("\t");
    out_.append_fixed(static_cast<double>(frame) / clip_.frame_rate_hz, time_decimals);
    for (std::size_t m = 0; m < clip_.marker_count(); ++m) {
      const Vec3 position = clip_.position(frame, m);
      for (const double value : {position.x, position.y, position.z}) {
        out_.append("\t");
        if (clip_.is_observed(frame, m)) write_coordinate(value);
      }
    }
    out_.append(style_.line_end);
  }

  void write_coordinate(double value) {
    if (style_.decimals <= most_fixed_decimals) return out_.append_fixed(value, style_.decimals);
    char room[fixed_number_room];
    out_.append(coordinate_text(value, room, most_fixed_decimals));
  }

  const Take& clip_;
  PlainStyle style_;
  TextBuffer out_;
};

}  // namespace

std::string write_trc(const Take& clip) {
  clip.validate();
  const auto* document = dynamic_cast<const TrcDocument*>(clip.source.document.get());
  const bool same_layout =
      document != nullptr && document->table.head_is_finite && clip.names == document->names &&
      clip.unit == document->unit && clip.frame_count() == document->table.frames &&
      clip.frame_rate_hz == document->frame_rate_hz && clip.first_frame == document->first_frame;
  if (same_layout) {
    if (auto bytes = rewrite_marker_table(clip, document->bytes, document->table))
      return *std::move(bytes);
  }
  if (clip.names.empty()) throw Error(ErrorKind::usage, "TRC cannot hold a clip without markers");
  return TrcWriter(clip, style_of(clip, document)).write();
}

}  // namespace kinemend
