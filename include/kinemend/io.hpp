#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/diagnostics.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// What a file holds: the motion of a skeleton, or of markers.
using Take = std::variant<Clip, MarkerClip>;

const SourceInfo& source_of(const Take& take);
SourceInfo& source_of(Take& take);

struct ReadOptions {
  std::string format;           ///< "bvh"; empty: found by content, then by extension
  bool strict = false;          ///< a repair becomes an error of kind `quality_limit`
  std::size_t max_depth = 512;  ///< joints nested deeper are an error
  /// The ASF file of an AMC file. Empty: the ASF named inside the AMC, else one of the same stem
  /// beside it, else that of the subject (`35.asf` for `35_01.amc`), else the only one there.
  std::filesystem::path skeleton;
  /// Rate of a file that has none (AMC, CSV without times) or none that a take may have, hertz, 0.1
  /// to 100,000; 0: the format's custom (120 for AMC), with a diagnostic `frame_rate_assumed`. A
  /// file that states a usable rate keeps it.
  double frame_rate_hz = 0;
  /// Told how far reading is (0..1); formats whose files are never large tell nothing on the way.
  std::function<void(double done)> progress;
};

struct ReadResult {
  Clip clip;
  Diagnostics diagnostics;
};

struct TakeResult {
  Take take;
  Diagnostics diagnostics;
};

/// Reads a take of any format. A value that is no finite number (nan, inf) is held from the frame
/// before, or from the next where there is none before; a rotation it belongs to is not `observed`.
/// Each format's page in docs/formats lists its repairs, which are diagnostics by name. Errors:
/// `ErrorKind::unreadable_input` with the file's name and line or byte, also for a file that would
/// need far more memory than it has bytes; `usage` for an unknown format; `quality_limit` for a
/// repair when `strict`.
TakeResult read_take(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from memory; `name` stands in messages and helps to find the format and the files
/// beside it. The bytes are kept (moved, not copied) in the take's source document.
TakeResult read_take(std::string bytes, std::string_view name, const ReadOptions& options = {});
/// `read_take` where joints are wanted. Errors: also `usage` for a file that holds markers.
ReadResult read_clip(const std::filesystem::path& path, const ReadOptions& options = {});
ReadResult read_clip(std::string bytes, std::string_view name, const ReadOptions& options = {});

/// The bytes of a file. A clip that was read in the same format is written in its source's own
/// layout, and every sample that still has the value it was read with keeps its digits: an
/// unchanged clip comes back to the byte, but for values of joints that were no finite numbers:
/// what they are held by is written, and never a number that is not finite. A changed rotation is
/// written in the joint's own order, continuing the frame before, and of it a joint's channels hold
/// what they can (the nearest rotation; nothing where it has none). A clip with other frames than
/// its source keeps the text of the hierarchy; one with another skeleton, or made in memory, gets a
/// plain layout. Errors: `usage` when the format cannot hold the clip.
std::string write_clip(const Clip& clip, std::string_view format = "bvh");
/// The same for markers. A missing sample is written the way the format has for it. Points that are
/// no positions are written to C3D only.
std::string write_markers(const MarkerClip& clip, std::string_view format);
std::string write_take(const Take& take, std::string_view format);
/// What a file that `write_take` makes of the take will not hold of what its source holds: analog
/// samples, force plates, events, subjects, parameters, rotations; nothing where all comes through.
/// Names are stable (`analog_lost`). Errors: `usage` for an unknown format.
Diagnostics lost_in_writing(const Take& take, std::string_view format);

/// A file that another one needs beside it.
struct SideFile {
  std::filesystem::path path;
  std::string bytes;
};
/// What else must stand in the folder of `output` so that `bytes`, the take as written in `format`,
/// can be read from there: the skeleton of an AMC file, under the name of the source's skeleton
/// where a reader would look for that, else under the take's own. Nothing where a reader would find
/// the same skeleton already, and for other formats.
std::optional<SideFile> side_file(const Take& take, std::string_view bytes, std::string_view format,
                                  const std::filesystem::path& output);

/// Writes `bytes` to a temporary file beside `path`, flushes it to the disk and renames it: `path`
/// holds its old content or all of the new one, never half. A file that is replaced keeps its
/// permissions, a symbolic link stays one and what it names is written, a device or a pipe is
/// written to, and "-" is standard output. Errors: `cannot_write`, also when the file exists and
/// `overwrite` is false.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool overwrite);
/// All of a file, or of standard input for "-". Errors: `unreadable_input`.
std::string read_file(const std::filesystem::path& path);

/// One file format, for help texts and detection.
struct Format {
  std::string_view name;                     ///< "bvh"
  std::string_view description;              ///< "Biovision hierarchy"
  std::vector<std::string_view> extensions;  ///< with the dot, lower case
  /// 0 to 100: how surely `head` (the first bytes of a file, 4096 at most) is of this format.
  int (*sniff)(std::string_view head);
  /// nullptr where the format is only written.
  TakeResult (*read)(std::string bytes, std::string_view name, const ReadOptions& options);
  std::string (*write)(const Clip& clip);  ///< nullptr where the format holds no joints
  std::string (*write_markers)(const MarkerClip& clip);  ///< nullptr where it holds no markers
};

std::span<const Format> formats();
/// The format of a file by its name alone; nullptr when the extension is not known.
const Format* format_of_path(const std::filesystem::path& path);

}  // namespace kinemend
