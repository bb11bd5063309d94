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

/// Reads a take. Errors: `ErrorKind::unreadable_input` with the file's name and line; `usage` for
/// an unknown format.
ReadResult read_clip(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from memory; `name` stands in messages and helps to find the format. The bytes are kept
/// (moved, not copied) in the clip's source document.
ReadResult read_clip(std::string bytes, std::string_view name, const ReadOptions& options = {});

/// The bytes of a file. A clip that was read in the same format is written in its source's own
/// layout, and every sample that still has the value it was read with keeps its digits. Errors:
/// `usage` when the format cannot hold the clip.
std::string write_clip(const Clip& clip, std::string_view format = "bvh");

/// Writes `bytes` to a temporary file beside `path`, flushes it to the disk and renames it: `path`
/// holds its old content or all of the new one, never half. Errors: `cannot_write`, also when the
/// file exists and `overwrite` is false.
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
