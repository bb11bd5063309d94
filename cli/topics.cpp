#include "topics.hpp"

#include <fmt/format.h>

#include "config.hpp"
#include "help.hpp"
#include "kinemend/io.hpp"

namespace kinemend::cli {

namespace {

std::string formats_text() {
  std::string text =
      "A file's format is found by its content, then by its extension; --from and "
      "--to name it where neither tells.";
  for (const Format& format : formats()) {
    const bool is_read = format.read != nullptr;
    const bool is_written = format.write != nullptr || format.write_markers != nullptr;
    text += fmt::format("\n\n{} ({}): {}; {}.", format.name, fmt::join(format.extensions, ", "),
                        format.description,
                        is_read && is_written ? "read and written"
                        : is_read             ? "read only"
                                              : "written only");
  }
  return text;
}

std::string presets_text() {
  std::string text =
      "--preset NAME of clean and batch chooses settings for a kind of motion. "
      "They go under --config and the command line.";
  for (const Preset& preset : presets())
    text += fmt::format("\n\n{}: {}.", preset.name, preset_summary(preset));
  return text;
}

std::string exit_codes_text() {
  std::string text = "Of several takes the highest code holds.";
  for (const ExitCode& code : exit_codes())
    text += fmt::format("\n\n{}: {}.", code.code, code.meaning);
  return text;
}

}  // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> table = {
      {"frames", "how frames are counted",
       "A frame has the number that its file gives it, wherever the program reads or writes one: "
       "in --range, in reports and findings, in JSON, in side files of gaps and of contacts. A C3D "
       "file states the number of its first frame, a TRC, TSV or CSV table and an AMC file that of "
       "their first row; takes that state none, as BVH, count from 1. Frames follow one another: "
       "where a table leaves numbers out, they are counted on from the first.\n\n"
       "Both ends of a span belong to it. A calibration pose at the start counts as a frame. "
       "Seconds (--range 1s:2.5s) count from the first frame, which is at 0 s."},
      {"names", "how joints and markers are named",
       "--joints, --markers, --exclude and --names take names and patterns, separated by commas: "
       "* is any text, ? any character; quote them. A marker is known without its subject too: "
       "LASI for Ann:LASI. Where nothing has that very name, capitals do not count.\n\n"
       "A side file for --map has lines NAME,NAME IN THE TAKE, for takes whose names mean nothing "
       "to the program; # starts a comment."},
      {"formats", "which files are read and written", formats_text()},
      {"presets", "settings for kinds of motion", presets_text()},
      {"gaps", "the side file of gaps, for --gaps",
       "Lines NAME,FIRST,LAST: a joint or marker, named as in --names (* for all), and its first "
       "and last missing frame. "
       "A heading, # comments, blank lines and quoted names are understood. kinemend check "
       "--gaps-out writes one."},
      {"live", "frames as they come, for kinemend stream",
       "The sender gives the hierarchy of a BVH file, MOTION, Frames: and Frame Time:, then a line "
       "of channel values a frame; lines end with LF, CR LF or ||, and each datagram ends one. A "
       "method with a window gives a frame when half a window has come behind it; the delay is "
       "printed.\n\n"
       "With --numbered a line begins with the frame's number, and lost frames are made up between "
       "those on either side, late and doubled ones left out. A malformed line is made up too. A "
       "sender may fall silent, go and come back, with or without its header; a client that does "
       "not read loses the oldest frames. The summary counts all of it.\n\n"
       "A stream of markers begins with a line MARKERS, the rate in hertz and the names, as in "
       "MARKERS 120 LASI,RASI; then come lines of three values a marker with commas between them, "
       "empty ones where a marker is missing.\n\n"
       "--format jsonl writes a line that describes the stream and one a frame: frame, root, "
       "rotations (quaternions w, x, y, z) and translations."},
      {"exit-codes", "what the exit code means", exit_codes_text()}};
  return table;
}

}  // namespace kinemend::cli
