// The text of each topic; formats, presets and exit codes come from their tables.
#include "topics.hpp"

#include <fmt/format.h>

#include "config.hpp"
#include "help.hpp"
#include "kinemend/io.hpp"

namespace kinemend::cli {

namespace {

std::string formats_text() {
  std::string text =
      "The format of a file is recognised by its content, then by its extension. If neither tells, "
      "use --from; for an output without an extension, use --to.";
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
      "With --preset NAME, clean and batch use a method with its settings. --config and options "
      "on the command line override them.";
  for (const Preset& preset : presets())
    text += fmt::format("\n\n{}: {}.", preset.name, preset_summary(preset));
  return text;
}

std::string exit_codes_text() {
  std::string text = "For several takes, the highest code is returned.";
  for (const ExitCode& code : exit_codes())
    text += fmt::format("\n\n{}: {}.", code.code, code.meaning);
  return text;
}

}  // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> table = {
      {"frames", "how frames are counted",
       "Frames have the numbers that the file gives them, everywhere: in --range, in reports, in "
       "JSON "
       "and in side files of gaps and contacts. A C3D file states the number of its first frame. "
       "In a "
       "TRC, TSV or CSV table and in an AMC file, the first row does. Takes without numbers, such "
       "as "
       "BVH, start at 1. From the first frame on, numbers go up by one, even if a table skips "
       "some.\n\n"
       "A range includes both of its ends. A calibration pose at the start counts as a frame. "
       "Times "
       "(--range 1s:2.5s) are measured from the first frame, which is at 0 s."},
      {"names", "how joints and markers are named",
       "--joints, --markers and --exclude take names and patterns, separated by commas. "
       "In a "
       "pattern * stands for any text and ? for any character; quote patterns. The subject may be "
       "omitted: LASI means Ann:LASI. If no name matches exactly, matching ignores case.\n\n"
       "A map (--map FILE) is for takes whose names the program does not know. Each line is "
       "NAME,NAME "
       "IN THE TAKE. # starts a comment."},
      {"formats", "which files are read and written", formats_text()},
      {"presets", "methods with their settings, by name", presets_text()},
      {"gaps", "the side file of gaps, for --gaps",
       "Each line is NAME,FIRST,LAST: a joint or marker, and its first and last missing frame. "
       "NAME is "
       "a name or pattern as in --joints; * means all. A header line, # comments, blank lines and "
       "quoted names are allowed. kinemend check --gaps-out writes such a file."},
      {"live", "live frames, for kinemend stream",
       "The sender sends the hierarchy of a BVH file, MOTION, Frames: and Frame Time:, and then "
       "one "
       "line of channel values per frame. Lines end with LF, CR LF or ||; the end of a datagram "
       "ends "
       "a line too. A method with a window writes a frame once it has seen half a window after it. "
       "This delay is printed.\n\n"
       "With --numbered each line begins with the number of its frame. Lost frames are then "
       "interpolated between their neighbours, and late and duplicate frames are ignored. With "
       "--udp, "
       "frames that arrive out of order are put back in order (--reorder). A malformed line is "
       "interpolated like a lost frame, except with --udp, where it is ignored: anyone can send a "
       "datagram. A sender may pause, disconnect and return, with or without its header. A client "
       "that does not read loses the oldest frames. The summary at the end counts all of this.\n\n"
       "A stream of markers begins with a line MARKERS, the rate in hertz and the names, such as "
       "MARKERS 120 LASI,RASI. Then each line has three values per marker, separated by commas. "
       "The "
       "values of a missing marker are empty.\n\n"
       "--vmc receives OSC datagrams of the VMC protocol and sends them to --to-vmc with cleaned "
       "bones; every other message passes unchanged and in order. --neuron receives the broadcast "
       "of Axis Neuron, which has no header. --feet holds feet that stand: they slide less, and "
       "knees may move less smoothly under noise.\n\n"
       "--format jsonl writes one line that describes the stream, and then one line per frame with "
       "frame, root, rotations (quaternions w, x, y, z) and translations."},
      {"exit-codes", "what the exit code means", exit_codes_text()}};
  return table;
}

}  // namespace kinemend::cli
