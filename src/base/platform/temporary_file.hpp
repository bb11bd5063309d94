// Writes a new file beside its target and then replaces the target as a whole.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "base/files.hpp"
#include "base/platform/files.hpp"

namespace kinemend::platform {

/// A new file in the target's folder that is deleted unless it gets its final name. If the file
/// system supports it, the file has no name until it is complete: then a killed process leaves
/// nothing behind. Errors of every function: `ErrorKind::cannot_write`, naming the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Owner and group are copied only if the user may set them. On Windows the replacement itself
  /// keeps attributes and access rights.
  void take_permissions(const FileFacts& old);
  /// Writes all bytes and flushes them to the disk.
  void fill(std::string_view bytes);
  /// Replaces the target, whether it exists or not.
  void replace_target();
  /// Fails if the target exists, even if it has just appeared.
  void become_target();

 private:
  int open_unnamed() const;
  int open_named();
  /// Returns -1 with `errno` if the file cannot be created or exists already.
  static int open_new(const std::filesystem::path& path);
  bool link_to(const std::filesystem::path& name) const;
  bool name_it();
  std::filesystem::path temporary_name() const;
  static long process_number();

  // Names that may be taken by files of killed processes. Chosen by hand, not swept.
  static constexpr int most_attempts = 100;

  std::filesystem::path target_;
  std::filesystem::path folder_;
  std::filesystem::path path_;  // empty while the file has no name
  std::optional<Descriptor> file_;
};

/// Throw `ErrorKind::cannot_write`, naming the file; the reason in words, or by its `errno`.
[[noreturn]] void fail_writing(const std::filesystem::path& path, std::string_view why);
[[noreturn]] void fail_writing(const std::filesystem::path& path, int error_number);

/// Flushes a folder, so that a power failure does not lose the name of a new file in it.
void flush_folder_of(const std::filesystem::path& file);

}  // namespace kinemend::platform
