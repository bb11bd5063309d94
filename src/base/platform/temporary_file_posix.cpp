// Replaces files on POSIX systems by rename.
#ifndef _WIN32
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "base/platform/temporary_file.hpp"

namespace kinemend::platform {

namespace {

namespace fs = std::filesystem;

std::string link_of(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) : target_(target) {
  folder_ = target.has_parent_path() ? target.parent_path() : fs::path(".");
  int descriptor = open_unnamed();
  if (descriptor < 0) descriptor = open_named();
  file_.emplace(descriptor);
}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void TemporaryFile::take_permissions(const FileFacts& old) {
  if (::fchown(file_->get(), old.owner, old.group) != 0) errno = 0;
  if (::fchmod(file_->get(), static_cast<mode_t>(old.mode)) != 0) fail_writing(target_, errno);
}

void TemporaryFile::fill(std::string_view bytes) {
  const int descriptor = file_->get();
  // Some file systems cannot flush; then a plain close must suffice.
  const bool written =
      write_all(descriptor, bytes) && (::fsync(descriptor) == 0 || errno == EINVAL);
  if (!written) fail_writing(target_, errno);
  // An unnamed file disappears when it is closed.
  if (!path_.empty() && !file_->close()) fail_writing(target_, errno);
}

void TemporaryFile::replace_target() {
  if (path_.empty() && !name_it()) fail_writing(target_, errno);
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail_writing(target_, errno);
  path_.clear();
}

// A link fails if the name exists, even if it has just appeared.
void TemporaryFile::become_target() {
  const bool linked =
      path_.empty() ? link_to(target_) : ::link(path_.c_str(), target_.c_str()) == 0;
  if (linked) return;
  if (errno == EEXIST) fail_writing(target_, "exists already and may not be replaced");
  replace_target();
}

int TemporaryFile::open_unnamed() const {
#ifdef O_TMPFILE
  const int descriptor = ::open(folder_.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  // Without /proc, as in a bare root, the file could never get a name.
  if (descriptor < 0 || ::access(link_of(descriptor).c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
#endif
  return -1;
}

int TemporaryFile::open_new(const fs::path& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

// Returns false with errno set. Links by way of /proc, which needs no privilege.
bool TemporaryFile::link_to(const fs::path& name) const {
  return ::linkat(AT_FDCWD, link_of(file_->get()).c_str(), AT_FDCWD, name.c_str(),
                  AT_SYMLINK_FOLLOW) == 0;
}

bool TemporaryFile::name_it() {
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

long TemporaryFile::process_number() { return ::getpid(); }

void flush_folder_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

}  // namespace kinemend::platform
#endif
