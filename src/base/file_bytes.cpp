// Reads files and pipes to their end, and reports why one cannot be read.
#include "base/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "base/descriptor.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

constexpr std::size_t unknown_size = 65536;

[[noreturn]] void fail(std::string_view name, int number) {
  throw Error(
      ErrorKind::unreadable_input,
      fmt::format("{}: {}", name, std::error_code(number, std::generic_category()).message()));
}

std::string read_all(int descriptor, std::size_t expected, std::string_view name) {
  // One byte more, so that the end is seen without growing.
  std::string bytes(expected + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(bytes.size() * 2 + unknown_size);
    const ssize_t count = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(name, errno);
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

std::string file_bytes(const std::filesystem::path& path) {
  if (path == "-") return read_all(STDIN_FILENO, unknown_size, "standard input");
  const std::string name = path.string();
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) fail(name, errno);
  if (S_ISDIR(info.st_mode)) fail(name, EISDIR);
  const bool is_regular = S_ISREG(info.st_mode);
  return read_all(file.get(), is_regular ? static_cast<std::size_t>(info.st_size) : unknown_size,
                  name);
}

}  // namespace kinemend
