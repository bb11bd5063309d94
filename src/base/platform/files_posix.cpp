// Files on POSIX systems.
#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "base/platform/files.hpp"

namespace kinemend::platform {

namespace {

FileFacts facts_from(const struct stat& info) {
  FileFacts facts;
  facts.kind = S_ISREG(info.st_mode)   ? FileKind::regular
               : S_ISDIR(info.st_mode) ? FileKind::folder
                                       : FileKind::other;
  facts.size = static_cast<std::uint64_t>(info.st_size);
  facts.mode = info.st_mode & 07777;
  facts.owner = info.st_uid;
  facts.group = info.st_gid;
  return facts;
}

}  // namespace

int open_to_read(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

int open_to_write(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
}

bool close_file(int file) { return ::close(file) == 0; }

std::ptrdiff_t read_some(int file, char* bytes, std::size_t most) {
  ssize_t count = 0;
  do {
    count = ::read(file, bytes, most);
  } while (count < 0 && errno == EINTR);
  return count;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::ptrdiff_t read_at(int file, std::uint64_t place, std::byte* bytes, std::size_t most) {
  ssize_t count = 0;
  do {
    count = ::pread(file, bytes, most, static_cast<off_t>(place));
  } while (count < 0 && errno == EINTR);
  return count;
}

std::ptrdiff_t write_at(int file, std::uint64_t place, const std::byte* bytes, std::size_t size) {
  ssize_t count = 0;
  do {
    count = ::pwrite(file, bytes, size, static_cast<off_t>(place));
  } while (count < 0 && errno == EINTR);
  return count;
}

FileFacts facts_of(int file) {
  struct stat info {};
  return ::fstat(file, &info) == 0 ? facts_from(info) : FileFacts{};
}

FileFacts facts_of(const std::filesystem::path& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? facts_from(info) : FileFacts{};
}

bool may_write(const std::filesystem::path& path) { return ::access(path.c_str(), W_OK) == 0; }

// The name is removed at once; the file exists as long as it is open.
int nameless_file(const std::string& folder) {
  std::string name = folder + "/kinemend-XXXXXX";
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

std::string words_of(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

}  // namespace kinemend::platform
#endif
