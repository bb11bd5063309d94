// Writes TRC in the layout of its source or in a plain one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/table/tables.hpp"
#include "io/table/trc_document.hpp"
#include "io/text/cell_patch.hpp"
#include "io/text/cell_rows.hpp"
#include "io/text/text_buffer.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

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
