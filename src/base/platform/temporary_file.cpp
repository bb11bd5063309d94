// The parts of temporary files that all systems share: their names and their errors.
#include "base/platform/temporary_file.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>

#include "kinemend/error.hpp"

namespace kinemend::platform {

namespace {

namespace fs = std::filesystem;

}  // namespace

int TemporaryFile::open_named() {
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    path_ = temporary_name();
    const int descriptor = open_new(path_);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST) break;
  }
  const int error = errno;
  path_.clear();
  fail_writing(target_, error);
}

fs::path TemporaryFile::temporary_name() const {
  static std::atomic<unsigned> counter{0};
  return folder_ / fmt::format(".kinemend-{}-{}.tmp", process_number(), counter++);
}

void fail_writing(const fs::path& path, std::string_view why) {
  throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", path.string(), why));
}
void fail_writing(const fs::path& path, int error_number) {
  fail_writing(path, words_of(error_number));
}

}  // namespace kinemend::platform
