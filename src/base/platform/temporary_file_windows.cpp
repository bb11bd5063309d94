// Replaces files on Windows by ReplaceFile, which keeps attributes and access rights, and
// MoveFileEx.
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include <cerrno>

#include "base/platform/temporary_file.hpp"
#include "base/platform/windows_paths.hpp"

namespace kinemend::platform {

namespace {

namespace fs = std::filesystem;

// A virus scanner may hold a newly written file for a moment.
bool with_patience(const auto& action) {
  // Half a second. Chosen by hand, not swept.
  constexpr int most_waits = 20;
  constexpr DWORD wait_ms = 25;
  for (int wait = 0;; ++wait) {
    if (action()) return true;
    const DWORD error = ::GetLastError();
    const bool is_held = error == ERROR_SHARING_VIOLATION || error == ERROR_LOCK_VIOLATION;
    if (!is_held || wait == most_waits) return fail_with_last_error();
    ::Sleep(wait_ms);
  }
}

bool replace(const std::wstring& target, const std::wstring& file) {
  constexpr DWORD flags = REPLACEFILE_IGNORE_MERGE_ERRORS | REPLACEFILE_IGNORE_ACL_ERRORS;
  const auto replaced = [&] {
    return ::ReplaceFileW(target.c_str(), file.c_str(), nullptr, flags, nullptr, nullptr) != 0;
  };
  const auto moved = [&] {
    return ::MoveFileExW(file.c_str(), target.c_str(),
                         MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0;
  };
  // Some file systems can only move.
  const bool exists = ::GetFileAttributesW(target.c_str()) != INVALID_FILE_ATTRIBUTES;
  return (exists && with_patience(replaced)) || with_patience(moved);
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) : target_(target) {
  folder_ = target.has_parent_path() ? target.parent_path() : fs::path(".");
  file_.emplace(open_named());
}

// Windows does not delete an open file.
TemporaryFile::~TemporaryFile() {
  if (path_.empty()) return;
  file_.reset();
  ::DeleteFileW(long_path(path_).c_str());
}

void TemporaryFile::take_permissions(const FileFacts& /*old*/) {}

void TemporaryFile::fill(std::string_view bytes) {
  const int descriptor = file_->get();
  if (!write_all(descriptor, bytes) || ::_commit(descriptor) != 0) fail_writing(target_, errno);
  if (!file_->close()) fail_writing(target_, errno);
}

void TemporaryFile::replace_target() {
  if (!replace(long_path(target_), long_path(path_))) fail_writing(target_, errno);
  path_.clear();
}

void TemporaryFile::become_target() {
  const std::wstring from = long_path(path_), to = long_path(target_);
  const bool moved = with_patience(
      [&] { return ::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_WRITE_THROUGH) != 0; });
  if (!moved && errno == EEXIST) fail_writing(target_, "exists already and may not be replaced");
  if (!moved) fail_writing(target_, errno);
  path_.clear();
}

int TemporaryFile::open_new(const fs::path& path) {
  return ::_wopen(long_path(path).c_str(),
                  _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

long TemporaryFile::process_number() { return ::_getpid(); }

// The move has already been written to disk.
void flush_folder_of(const fs::path& /*file*/) {}

}  // namespace kinemend::platform
#endif
