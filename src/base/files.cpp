// Reads files and pipes to their end, and reports why one cannot be read. Writes and reads the
// records of a spool, whose file has no name. Computes the hash of a content with XXH3.
#include "base/files.hpp"

#include <fmt/format.h>

// The functions are compiled here, so that no library is needed.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/platform/files.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"

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

namespace {

[[noreturn]] void fail(ErrorKind kind, const std::string& folder, const char* what, int number) {
  throw Error(kind,
              fmt::format("{}: temporary file: {}: {}", folder, what, platform::words_of(number)));
}

std::string temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder.string();
  const char* named = std::getenv("TMPDIR");
  const std::string wanted = named != nullptr ? named : "/tmp";
  // Standard libraries differ in their result for a folder that does not exist.
  std::error_code ignored;
  const bool exists = std::filesystem::exists(wanted, ignored);
  fail(ErrorKind::cannot_write, wanted, "cannot be made", exists ? error.value() : ENOENT);
}

int nameless_file(const std::string& folder) {
  const int descriptor = platform::nameless_file(folder);
  if (descriptor < 0) fail(ErrorKind::cannot_write, folder, "cannot be made", errno);
  return descriptor;
}

}  // namespace

std::size_t Spool::append(std::span<const std::byte> bytes) {
  Record record;
  record.size = bytes.size();
  if (!file_ && bytes.size() <= room_) {
    record.memory.assign(bytes.begin(), bytes.end());
    room_ -= bytes.size();
  } else {
    record.place = file_end_;
    write_to_file(bytes);
  }
  records_.push_back(std::move(record));
  return records_.size() - 1;
}

void Spool::write_to_file(std::span<const std::byte> bytes) {
  if (!file_) file_ = std::make_unique<Descriptor>(nameless_file(temporary_folder()));
  for (std::size_t done = 0; done < bytes.size();) {
    const std::ptrdiff_t count = platform::write_at(file_->get(), file_end_ + done,
                                                    bytes.data() + done, bytes.size() - done);
    if (count <= 0)
      fail(ErrorKind::cannot_write, temporary_folder(), "cannot be written",
           count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
  file_end_ += bytes.size();
}

void Spool::read(std::size_t record, std::size_t from, std::span<std::byte> bytes) const {
  const Record& entry = records_[record];
  assert(from + bytes.size() <= entry.size);
  if (bytes.empty()) return;
  if (!entry.memory.empty()) {
    std::memcpy(bytes.data(), entry.memory.data() + from, bytes.size());
    return;
  }
  for (std::size_t done = 0; done < bytes.size();) {
    const std::ptrdiff_t count = platform::read_at(file_->get(), entry.place + from + done,
                                                   bytes.data() + done, bytes.size() - done);
    if (count <= 0)
      fail(ErrorKind::unreadable_input, temporary_folder(), "cannot be read",
           count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
}

std::string content_hash(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace kinemend
