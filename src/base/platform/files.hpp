// Files of the operating system. Each system has one source file; nothing else calls the system.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace kinemend::platform {

// The standard streams' numbers, on every system.
constexpr int standard_input = 0, standard_output = 1, standard_error = 2;

// Every function below that can fail returns -1 or false and sets `errno`. Files are opened in
// binary mode: line ends are not translated. Child processes do not inherit them.

/// Returns the number of an open file. For a folder `errno` is EISDIR if the system does not open
/// one.
int open_to_read(const std::filesystem::path& path);
/// Opens an existing file, or a device.
int open_to_write(const std::filesystem::path& path);
bool close_file(int file);

/// Reads at most `most` bytes. Returns their number; 0: the end.
std::ptrdiff_t read_some(int file, char* bytes, std::size_t most);
/// Writes all bytes.
bool write_all(int file, std::string_view bytes);

/// Reads or writes at a place of the file. Several threads may read at once.
std::ptrdiff_t read_at(int file, std::uint64_t place, std::byte* bytes, std::size_t most);
std::ptrdiff_t write_at(int file, std::uint64_t place, const std::byte* bytes, std::size_t size);

enum class FileKind : std::uint8_t { none, regular, folder, other };
struct FileFacts {
  FileKind kind = FileKind::none;
  std::uint64_t size = 0;  // bytes
  // Properties that a replacement of this file keeps, if the system has them.
  std::uint32_t mode = 0, owner = 0, group = 0;
};
/// Returns `FileKind::none` with `errno` on failure. Symlinks are followed.
FileFacts facts_of(int file);
FileFacts facts_of(const std::filesystem::path& path);
/// Whether the user may write to an existing file.
bool may_write(const std::filesystem::path& path);

/// Creates a file in `folder` that disappears once it is closed, however the program ends.
int nameless_file(const std::string& folder);

/// The text for an error number, the same on every system for the common ones.
std::string words_of(int error_number);

}  // namespace kinemend::platform
