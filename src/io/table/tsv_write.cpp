// Writes TSV in the layout of its source or in a plain one.
#include <fmt/format.h>

#include <algorithm>

#include "io/table/tables.hpp"
#include "io/table/tsv_document.hpp"
#include "io/text/cell_patch.hpp"
#include "io/text/cell_rows.hpp"
#include "io/text/text_buffer.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

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
