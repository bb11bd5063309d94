#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

namespace fs = std::filesystem;

std::string reason(int number) {
  return std::error_code(number, std::generic_category()).message();
}

[[noreturn]] void fail_reading(std::string_view name, std::string_view why) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}: {}", name, why));
}

[[noreturn]] void fail_writing(const fs::path& path, std::string_view why) {
  throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", path.string(), why));
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ > STDERR_FILENO) ::close(number_);
  }
  int get() const { return number_; }
  // What is left unwritten on some file systems shows only here.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

std::string read_all(int descriptor, std::size_t expected, std::string_view name) {
  // One byte more, so that the end is seen without growing.
  std::string bytes(expected + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(bytes.size() * 2 + 65536);
    const ssize_t count = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_reading(name, reason(errno));
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  bytes.resize(used);
  return bytes;
}

// False with errno set.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// A new file in `folder` that vanishes again unless it is given its final name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    static std::atomic<unsigned> counter{0};
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    int descriptor = -1;
    for (int attempt = 0; attempt < 100 && descriptor < 0; ++attempt) {
      path_ = folder / fmt::format(".kinemend-{}-{}.tmp", ::getpid(), counter++);
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) {
      const int error = errno;
      path_.clear();
      fail_writing(target_, reason(error));
    }
    file_.emplace(descriptor);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  // Owner and group only where the user may give them away.
  void take_permissions(const struct stat& old) {
    if (::fchown(file_->get(), old.st_uid, old.st_gid) != 0) errno = 0;
    if (::fchmod(file_->get(), old.st_mode & 07777) != 0) fail_writing(target_, reason(errno));
  }

  void fill(std::string_view bytes) {
    const int descriptor = file_->get();
    // Some file systems cannot flush; then a plain close has to do.
    const bool written =
        write_all(descriptor, bytes) && (::fsync(descriptor) == 0 || errno == EINVAL);
    if (!written) fail_writing(target_, reason(errno));
    if (!file_->close()) fail_writing(target_, reason(errno));
  }

  void replace_target() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail_writing(target_, reason(errno));
    path_.clear();
  }

  // A link fails where the name is taken, also when it was taken a moment ago.
  void become_target() {
    if (::link(path_.c_str(), target_.c_str()) == 0) return;
    if (errno == EEXIST) fail_writing(target_, "exists already and may not be replaced");
    replace_target();
  }

 private:
  fs::path target_;
  fs::path path_;
  std::optional<Descriptor> file_;
};

void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

// A pipe, a terminal or /dev/null is written to, not replaced.
void write_through(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), bytes)) fail_writing(path, reason(errno));
}

}  // namespace

std::string read_file(const fs::path& path) {
  if (path == "-") return read_all(STDIN_FILENO, 65536, "standard input");
  const std::string name = path.string();
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) fail_reading(name, reason(errno));
  if (S_ISDIR(info.st_mode)) fail_reading(name, reason(EISDIR));
  return read_all(file.get(),
                  S_ISREG(info.st_mode) ? static_cast<std::size_t>(info.st_size) : 65536, name);
}

void write_file(const fs::path& path, std::string_view bytes, bool overwrite) {
  if (path == "-") {
    if (!write_all(STDOUT_FILENO, bytes)) fail_writing("standard output", reason(errno));
    return;
  }
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) fail_writing(path, reason(EISDIR));
  if (exists && !S_ISREG(old.st_mode)) return write_through(path, bytes);
  std::error_code ignored;
  const bool link = fs::is_symlink(path, ignored);
  if ((exists || link) && !overwrite) fail_writing(path, "exists already and may not be replaced");
  if (exists && ::access(path.c_str(), W_OK) != 0) fail_writing(path, reason(errno));
  // A symbolic link stays one; what it points to is replaced.
  const fs::path target = link ? fs::weakly_canonical(path, ignored) : path;
  if (target.empty()) fail_writing(path, "names no file");
  TemporaryFile file(target);
  if (exists) file.take_permissions(old);
  file.fill(bytes);
  if (exists || link) {
    file.replace_target();
  } else {
    file.become_target();
  }
  flush_folder(target);
}

}  // namespace kinemend
