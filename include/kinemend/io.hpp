#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/diagnostics.hpp"

namespace kinemend {

struct ReadOptions {
  std::string format;           ///< "bvh"; empty: found by content, then by extension
  bool strict = false;          ///< a repair becomes an error of kind `quality_limit`
  std::size_t max_depth = 512;  ///< joints nested deeper are an error
};

struct ReadResult {
  Clip clip;
  Diagnostics diagnostics;
};

/// Reads a take. A value that is no finite number (nan, inf) is held from the frame before, or from
/// the next where there is none before; a rotation it belongs to is not `observed`. Repairs of BVH,
/// by name: `frame_count_mismatch`, `frame_count_missing`, `frame_time_missing`,
/// `frame_time_unusable` (30 Hz is assumed), `motion_missing`, `hierarchy_keyword_missing`,
/// `offset_missing`, `value_not_finite`, `comment_skipped`, `trailing_text`, `decimal_comma`,
/// `comma_separator`. Errors: `ErrorKind::unreadable_input` with the file's name and line, also for
/// a file that would need far more memory than it has bytes; `usage` for an unknown format;
/// `quality_limit` for a repair when `strict`.
ReadResult read_clip(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from memory; `name` stands in messages and helps to find the format. The bytes are kept
/// (moved, not copied) in the clip's source document.
ReadResult read_clip(std::string bytes, std::string_view name, const ReadOptions& options = {});

/// The bytes of a file. A clip that was read in the same format is written in its source's own
/// layout, and every sample that still has the value it was read with keeps its digits: an
/// unchanged clip comes back to the byte. A changed rotation is written in the joint's own order,
/// continuing the frame before, and of it a joint's channels hold what they can (the nearest
/// rotation; nothing where it has none). A clip with other frames than its source keeps the text of
/// the hierarchy; one with another skeleton, or made in memory, gets a plain layout. Errors:
/// `usage` when the format cannot hold the clip.
std::string write_clip(const Clip& clip, std::string_view format = "bvh");

/// Writes `bytes` to a temporary file beside `path`, flushes it to the disk and renames it: `path`
/// holds its old content or all of the new one, never half. A file that is replaced keeps its
/// permissions, a symbolic link stays one, a device or a pipe is written to, and "-" is standard
/// output. Errors: `cannot_write`, also when the file exists and `overwrite` is false.
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
  ReadResult (*read)(std::string bytes, std::string_view name, const ReadOptions& options);
  std::string (*write)(const Clip& clip);
};

std::span<const Format> formats();
/// The format of a file by its name alone; nullptr when the extension is not known.
const Format* format_of_path(const std::filesystem::path& path);

}  // namespace kinemend
