// Reads takes from files of any format, and writes them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

struct ReadOptions {
  std::string format;           ///< "bvh"; empty: detected by content, then by extension
  bool strict = false;          ///< every repair is an error of kind `quality_limit`
  std::size_t max_depth = 512;  ///< deeper nesting of joints is an error
  /// The ASF file of an AMC file. Empty: the ASF that the AMC file names, else one of the same stem
  /// beside it, else the ASF of the subject (`35.asf` for `35_01.amc`), else the only ASF in the
  /// folder.
  std::filesystem::path skeleton;
  /// Frame rate in hertz, 0.1 to 100,000, for a file that states no rate (AMC, CSV without times)
  /// or an unusable one; 0: the usual rate of the format (120 for AMC), with a diagnostic
  /// `frame_rate_assumed`. A file that states a usable rate keeps it.
  double frame_rate_hz = 0;
  /// Called with the share of the file that has been read (0 to 1). Readers of small formats never
  /// call it.
  std::function<void(double done)> progress;
  /// Name of the take to read from a file that holds several (FBX, glTF); `#2` is the second take
  /// if it has no name. Empty: the active take, else the first that moves a joint. Errors: `usage`
  /// for a name that the file does not have.
  std::string animation;
};

struct TakeResult {
  Take take;
  Diagnostics diagnostics;
};

/// Reads a take of any format. The content decides the format; a file whose extension belongs to
/// another format gets the diagnostic `extension_mismatch`. A value that is not finite (nan, inf)
/// is missing: a marker has no position in that frame; a joint holds the value of the frame before,
/// else of the next, and is not `observed`. A text file that ends in the middle of a line is read
/// up to that line (`file_cut`). The page of each format in docs/formats lists its repairs, each a
/// named diagnostic. Errors: `ErrorKind::unreadable_input` with the name of the file and the line
/// or byte, also for a file that would need far more memory than it has bytes; `usage` for an
/// unknown format; `quality_limit` for a repair when `strict`.
TakeResult read_take(const std::filesystem::path& path, const ReadOptions& options = {});
/// Reads a take from memory. `name` appears in messages and helps to find the format and the files
/// beside it. The source document of the take keeps the bytes (moved, not copied).
TakeResult read_take(std::string bytes, std::string_view name, const ReadOptions& options = {});
/// `read_take` for joints only. Errors: also `usage` for a file of markers.
TakeResult read_joints(const std::filesystem::path& path, const ReadOptions& options = {});
TakeResult read_joints(std::string bytes, std::string_view name, const ReadOptions& options = {});

/// Returns the bytes of a file in `format`; empty: the format that the take was read from, else BVH
/// for joints and C3D for markers. In the clip's own format the layout of the source is kept, and
/// every unchanged sample keeps its digits: an unchanged clip is written byte for byte. The
/// exception is a value that was not finite: the value that replaced it is written, because no
/// output holds a number that is not finite. A changed rotation is written in the rotation order of
/// its joint and continues the angles of the frame before. A joint with fewer than three channels
/// gets the nearest rotation that its channels can express. A clip whose frames differ from its
/// source's keeps the text of the hierarchy. A clip with another skeleton, or made in memory, gets
/// a plain layout. Errors: `usage` when the format cannot hold the clip. Markers: a missing sample
/// is written as the format defines it, and points that are not positions are written to C3D only.
std::string write_take(const Take& take, std::string_view format = {});
/// One number per frame, such as the contact of a foot, for an engine.
struct NamedCurve {
  std::string name;            ///< "contact_l"
  std::vector<double> values;  ///< F
};
/// Returns a new file of joints and their motion with these curves: in FBX animated properties of
/// the first joint, in GLB `extras.curves` of the animation, at the times of its keys. The mesh and
/// everything else of a source are left out. Errors: `usage` for another format, a take of markers,
/// and a curve of another length.
std::string write_with_curves(const Take& take, std::string_view format,
                              std::span<const NamedCurve> curves);
/// Lists the data that `write_take` loses when it writes the take in `format`: analog samples,
/// force plates, events, subjects, parameters, rotations. Empty if nothing is lost. Names are
/// stable (`not_kept`). Errors: `usage` for an unknown format.
Diagnostics lost_in_writing(const Take& take, std::string_view format);

/// Returns the force plates of the C3D file that a take comes from, of types 1 to 5, with corners
/// in the unit and axes of the take. Loads start at zero: FORCE_PLATFORM:ZERO names the frames
/// without load. Empty for other takes, and for analog samples that no channel explains.
std::vector<ForcePlate> force_plates(const Take& take);

/// A file that another file needs in the same folder.
struct SideFile {
  std::filesystem::path path;
  std::string bytes;
};
/// Returns the file that a reader of `output` needs beside it: the skeleton of an AMC file. `bytes`
/// is the take as written in `format`. The file is named after the source's skeleton if a reader
/// looks for that name, else after the take. Empty for other formats, and if a reader already finds
/// the same skeleton.
std::optional<SideFile> side_file(const Take& take, std::string_view bytes, std::string_view format,
                                  const std::filesystem::path& output);

/// A take as a file, with the files that it needs in the same folder or below.
struct TakeFiles {
  std::string bytes;
  std::vector<SideFile> beside;
};
/// Combines `write_take` and `side_file` for an output whose path is known. If the buffers of a
/// glTF text are separate files, a changed buffer is also a separate file, named after the output:
/// `walk.gltf` and `walk.bin`. If the output is not in the source's folder, the files that the glTF
/// text names are included.
TakeFiles files_of_take(const Take& take, std::string_view format,
                        const std::filesystem::path& output);

/// Writes `bytes` to a temporary file beside `path`, flushes it to the disk and renames it, so that
/// `path` always holds either its old content or all of the new content. A replaced file keeps its
/// permissions. Symlinks are followed, not replaced. Devices and pipes are written directly; "-" is
/// standard output. Errors: `cannot_write`, also when the file exists and `overwrite` is false.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool overwrite);
/// Returns the bytes of a file, or of standard input for "-". Errors: `unreadable_input`.
std::string read_file(const std::filesystem::path& path);

/// One file format, for help texts and detection.
struct Format {
  std::string_view name;                     ///< "bvh"
  std::string_view description;              ///< "Biovision hierarchy"
  std::vector<std::string_view> extensions;  ///< with the dot, lower case
  /// 0 to 100: how likely `head` (the first bytes of a file, at most 4096) is of this format.
  int (*sniff)(std::string_view head);
  /// nullptr for a format that is only written.
  TakeResult (*read)(std::string bytes, std::string_view name, const ReadOptions& options);
  std::string (*write)(const Take& clip);          ///< nullptr for a format without joints
  std::string (*write_markers)(const Take& clip);  ///< nullptr for a format without markers
  /// Lists the parts of the take's source in this format that a new file leaves out; none if the
  /// source is rewritten. nullptr for formats that hold motion only.
  std::vector<std::string> (*left_out)(const Take& take) = nullptr;
  /// Writes a take with the files that `output` needs beside it; nullptr where `write` and
  /// `side_file` do.
  TakeFiles (*write_files)(const Take& take, const std::filesystem::path& output) = nullptr;
};

std::span<const Format> formats();
/// Finds the format of a file by its extension alone; nullptr for an unknown extension.
const Format* format_of_path(const std::filesystem::path& path);
/// Finds the format of a file by its first bytes (`head`, at most 4096); nullptr if no format
/// matches.
const Format* format_of_content(std::string_view head);

}  // namespace kinemend
