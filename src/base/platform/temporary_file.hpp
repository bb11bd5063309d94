// A new file beside its target, which it then replaces as a whole.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "base/descriptor.hpp"
#include "base/platform/files.hpp"

namespace kinemend::platform {

/// A new file in the target's folder that vanishes again unless it is given its final name. Where
/// the file system can do it, the file has no name at all until it is whole: then nothing is left
/// of a process that is killed. Errors of every function: `ErrorKind::cannot_write`, naming the
/// target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Owner and group are taken over only where the user may give them away. On Windows the
  /// replacement itself keeps attributes and access rights.
  void take_permissions(const FileFacts& old);
  /// Writes all bytes and flushes them to the disk.
  void fill(std::string_view bytes);
  /// Takes the place of the target, whether that exists or not.
  void replace_target();
  /// Fails where the target exists, also when it appeared a moment ago.
  void become_target();

 private:
  int open_unnamed() const;
  int open_named();
  /// -1 with `errno` where it cannot be made, or exists already.
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

/// Flushes a folder, so that the name of a new file in it is not lost with the power.
void flush_folder_of(const std::filesystem::path& file);

}  // namespace kinemend::platform
