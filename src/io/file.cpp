// Reads whole files, and writes them so that an output is either complete or absent.
#include <cerrno>
#include <system_error>

#include "base/files.hpp"
#include "base/platform/files.hpp"
#include "base/platform/temporary_file.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

namespace fs = std::filesystem;

using platform::fail_writing;

// Follows symlinks: the target is replaced, or created if it does not exist.
fs::path without_links(fs::path path) {
  constexpr int most_links = 40;  // the limit of the Linux kernel
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    if (links == most_links) fail_writing(path, ELOOP);
    const fs::path next = fs::read_symlink(path, error);
    if (error) fail_writing(path, error.message());
    path = path.parent_path() / next;
  }
  return path;
}

// Writes directly to a pipe, a terminal or /dev/null, which must not be replaced.
void write_through(const fs::path& path, std::string_view bytes) {
  const Descriptor file(platform::open_to_write(path));
  if (file.get() < 0 || !platform::write_all(file.get(), bytes)) fail_writing(path, errno);
}

}  // namespace

std::string read_file(const fs::path& path) { return file_bytes(path); }

void write_file(const fs::path& path, std::string_view bytes, bool overwrite) {
  if (path == "-") {
    if (!platform::write_all(platform::standard_output, bytes))
      fail_writing("standard output", errno);
    return;
  }
  using platform::FileKind;
  const platform::FileFacts old = platform::facts_of(path);
  const bool exists = old.kind != FileKind::none;
  if (old.kind == FileKind::folder) fail_writing(path, EISDIR);
  if (old.kind == FileKind::other) return write_through(path, bytes);
  if (exists && !overwrite) fail_writing(path, "exists already and may not be replaced");
  if (exists && !platform::may_write(path)) fail_writing(path, errno);
  const fs::path target = without_links(path);
  platform::TemporaryFile file(target);
  if (exists) file.take_permissions(old);
  file.fill(bytes);
  // With `overwrite`, the target may also have been created a moment ago.
  if (overwrite) {
    file.replace_target();
  } else {
    file.become_target();
  }
  platform::flush_folder_of(target);
}

}  // namespace kinemend
