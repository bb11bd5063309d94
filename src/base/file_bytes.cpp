// Reads files and pipes to their end, and reports why one cannot be read.
#include "base/file_bytes.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <string_view>

#include "base/descriptor.hpp"
#include "base/platform/files.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Bytes that are read at first if the size is unknown. For speed, not swept.
constexpr std::size_t unknown_size = 65536;

[[noreturn]] void fail(std::string_view name, int number) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}: {}", name, platform::words_of(number)));
}

std::string read_all(int descriptor, std::size_t expected, std::string_view name) {
  // One byte more, so that the end is detected without growing.
  std::string bytes(expected + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(bytes.size() * 2 + unknown_size);
    const std::ptrdiff_t count =
        platform::read_some(descriptor, bytes.data() + used, bytes.size() - used);
    if (count < 0) fail(name, errno);
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

std::string file_bytes(const std::filesystem::path& path) {
  if (path == "-") return read_all(platform::standard_input, unknown_size, "standard input");
  using platform::FileKind;
  const std::string name = path.string();
  const Descriptor file(platform::open_to_read(path));
  if (file.get() < 0) fail(name, errno);
  const platform::FileFacts facts = platform::facts_of(file.get());
  if (facts.kind == FileKind::none) fail(name, errno);
  if (facts.kind == FileKind::folder) fail(name, EISDIR);
  const bool is_regular = facts.kind == FileKind::regular;
  return read_all(file.get(), is_regular ? static_cast<std::size_t>(facts.size) : unknown_size,
                  name);
}

}  // namespace kinemend
