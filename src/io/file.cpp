// Reads whole files, and writes them so that an output is complete or not there at all.
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

#include "base/descriptor.hpp"
#include "base/file_bytes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

namespace fs = std::filesystem;

std::string reason(int number) {
  return std::error_code(number, std::generic_category()).message();
}

[[noreturn]] void fail_writing(const fs::path& path, std::string_view why) {
  throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", path.string(), why));
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

// A new file in the target's folder that vanishes again unless it is given its final name. Where
// the file system can do it, the file has no name at all until it is whole: then nothing is left of
// a process that is killed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    folder_ = target.has_parent_path() ? target.parent_path() : fs::path(".");
    int descriptor = open_unnamed();
    if (descriptor < 0) descriptor = open_named();
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
    // An unnamed file is gone once it is closed.
    if (!path_.empty() && !file_->close()) fail_writing(target_, reason(errno));
  }

  void replace_target() {
    if (path_.empty() && !name_it()) fail_writing(target_, reason(errno));
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail_writing(target_, reason(errno));
    path_.clear();
  }

  // A link fails where the name is taken, also when it was taken a moment ago.
  void become_target() {
    const bool linked =
        path_.empty() ? link_to(target_) : ::link(path_.c_str(), target_.c_str()) == 0;
    if (linked) return;
    if (errno == EEXIST) fail_writing(target_, "exists already and may not be replaced");
    replace_target();
  }

 private:
  int open_unnamed() const {
#ifdef O_TMPFILE
    const int descriptor = ::open(folder_.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    // Without /proc, as in a bare root, it could never be given a name.
    if (descriptor < 0 || ::access(link_of(descriptor).c_str(), F_OK) == 0) return descriptor;
    ::close(descriptor);
#endif
    return -1;
  }

  int open_named() {
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      path_ = temporary_name();
      const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0) return descriptor;
      if (errno != EEXIST) break;
    }
    const int error = errno;
    path_.clear();
    fail_writing(target_, reason(error));
  }

  static std::string link_of(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

  // False with errno set. By way of /proc, which needs no privilege.
  bool link_to(const fs::path& name) const {
    return ::linkat(AT_FDCWD, link_of(file_->get()).c_str(), AT_FDCWD, name.c_str(),
                    AT_SYMLINK_FOLLOW) == 0;
  }

  bool name_it() {
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      const fs::path name = temporary_name();
      if (link_to(name)) {
        path_ = name;
        return true;
      }
      if (errno != EEXIST) return false;
    }
    return false;
  }

  fs::path temporary_name() const {
    static std::atomic<unsigned> counter{0};
    return folder_ / fmt::format(".kinemend-{}-{}.tmp", ::getpid(), counter++);
  }

  static constexpr int most_attempts = 100;
  fs::path target_;
  fs::path folder_;
  fs::path path_;  // empty while the file has no name
  std::optional<Descriptor> file_;
};

void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

// A symbolic link stays one; what it points to is replaced, or made where it is not there.
fs::path without_links(fs::path path) {
  constexpr int most_links = 40;  // as the kernel has it
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    if (links == most_links) fail_writing(path, reason(ELOOP));
    const fs::path next = fs::read_symlink(path, error);
    if (error) fail_writing(path, error.message());
    path = path.parent_path() / next;
  }
  return path;
}

// A pipe, a terminal or /dev/null is written to, not replaced.
void write_through(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), bytes)) fail_writing(path, reason(errno));
}

}  // namespace

std::string read_file(const fs::path& path) { return file_bytes(path); }

void write_file(const fs::path& path, std::string_view bytes, bool overwrite) {
  if (path == "-") {
    if (!write_all(STDOUT_FILENO, bytes)) fail_writing("standard output", reason(errno));
    return;
  }
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) fail_writing(path, reason(EISDIR));
  if (exists && !S_ISREG(old.st_mode)) return write_through(path, bytes);
  if (exists && !overwrite) fail_writing(path, "exists already and may not be replaced");
  if (exists && ::access(path.c_str(), W_OK) != 0) fail_writing(path, reason(errno));
  const fs::path target = without_links(path);
  TemporaryFile file(target);
  if (exists) file.take_permissions(old);
  file.fill(bytes);
  // What may be replaced may also have come a moment ago.
  if (overwrite) {
    file.replace_target();
  } else {
    file.become_target();
  }
  flush_folder(target);
}

}  // namespace kinemend
