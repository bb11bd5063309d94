// Files on Windows.
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <system_error>

#include "base/platform/files.hpp"
#include "base/platform/windows_paths.hpp"

namespace kinemend::platform {

namespace {

namespace fs = std::filesystem;

constexpr int for_bytes = _O_BINARY | _O_NOINHERIT;
constexpr std::size_t most_at_once = std::size_t{1} << 30;  // counts have 31 bits

bool is_folder(const fs::path& path) {
  const DWORD attributes = ::GetFileAttributesW(long_path(path).c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

int open_as(const fs::path& path, int flags) {
  if (is_folder(path)) {
    errno = EISDIR;
    return -1;
  }
  return ::_wopen(long_path(path).c_str(), flags | for_bytes);
}

OVERLAPPED at(std::uint64_t place) {
  OVERLAPPED where{};
  where.Offset = static_cast<DWORD>(place);
  where.OffsetHigh = static_cast<DWORD>(place >> 32);
  return where;
}

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file)); }

}  // namespace

std::wstring long_path(const fs::path& path) {
  // Chosen by hand.
  constexpr std::size_t longest_plain = 240;  // of 260, less the name of a temporary file
  std::error_code error;
  const std::wstring text = path.native();
  if (text.starts_with(L"\\\\?\\")) return text;
  const fs::path absolute = fs::absolute(path, error);
  if (error || absolute.native().size() < longest_plain) return text;
  std::wstring whole = absolute.lexically_normal().native();
  std::replace(whole.begin(), whole.end(), L'/', L'\\');
  return whole.starts_with(L"\\\\") ? L"\\\\?\\UNC" + whole.substr(1) : L"\\\\?\\" + whole;
}

bool fail_with_last_error() {
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  const std::error_condition condition = code.default_error_condition();
  errno = condition.category() == std::generic_category() ? condition.value() : EIO;
  return false;
}

int open_to_read(const fs::path& path) { return open_as(path, _O_RDONLY); }
int open_to_write(const fs::path& path) { return open_as(path, _O_WRONLY); }
bool close_file(int file) { return ::_close(file) == 0; }

std::ptrdiff_t read_some(int file, char* bytes, std::size_t most) {
  return ::_read(file, bytes, static_cast<unsigned>(std::min(most, most_at_once)));
}

bool write_all(int file, std::string_view bytes) {
  // A console takes at most 32,767 bytes at a time.
  const std::size_t most = ::_isatty(file) != 0 ? 8192 : most_at_once;
  while (!bytes.empty()) {
    const int count =
        ::_write(file, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), most)));
    // A pipe that its reader has closed is reported as an invalid argument.
    if (count < 0 && (errno == EINVAL || ::GetLastError() == ERROR_NO_DATA)) errno = EPIPE;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::ptrdiff_t read_at(int file, std::uint64_t place, std::byte* bytes, std::size_t most) {
  OVERLAPPED where = at(place);
  DWORD count = 0;
  const auto wanted = static_cast<DWORD>(std::min(most, most_at_once));
  if (::ReadFile(handle_of(file), bytes, wanted, &count, &where) == 0) {
    if (::GetLastError() == ERROR_HANDLE_EOF) return 0;
    fail_with_last_error();
    return -1;
  }
  return static_cast<std::ptrdiff_t>(count);
}

std::ptrdiff_t write_at(int file, std::uint64_t place, const std::byte* bytes, std::size_t size) {
  OVERLAPPED where = at(place);
  DWORD count = 0;
  const auto given = static_cast<DWORD>(std::min(size, most_at_once));
  if (::WriteFile(handle_of(file), bytes, given, &count, &where) == 0) {
    fail_with_last_error();
    return -1;
  }
  return static_cast<std::ptrdiff_t>(count);
}

FileFacts facts_of(int file) {
  FileFacts facts;
  const HANDLE handle = handle_of(file);
  LARGE_INTEGER size{};
  facts.kind = ::GetFileType(handle) == FILE_TYPE_DISK ? FileKind::regular : FileKind::other;
  if (facts.kind == FileKind::regular && ::GetFileSizeEx(handle, &size) != 0)
    facts.size = static_cast<std::uint64_t>(size.QuadPart);
  return facts;
}

FileFacts facts_of(const fs::path& path) {
  FileFacts facts;
  std::error_code error;
  const fs::file_status status = fs::status(long_path(path), error);
  errno = error ? error.default_error_condition().value() : 0;
  if (!fs::exists(status)) return facts;
  facts.kind = fs::is_regular_file(status) ? FileKind::regular
               : fs::is_directory(status)  ? FileKind::folder
                                           : FileKind::other;
  return facts;
}

bool may_write(const fs::path& path) {
  constexpr int to_write = 2;
  return ::_waccess(long_path(path).c_str(), to_write) == 0;
}

int nameless_file(const std::string& folder) {
  static std::atomic<unsigned> counter{0};
  // Chosen by hand.
  constexpr int most_attempts = 100;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const fs::path path = fs::path(folder) / ("kinemend-" + std::to_string(::_getpid()) + "-" +
                                              std::to_string(counter++) + ".spool");
    // Windows deletes the file once it is closed.
    const int file = ::_wopen(long_path(path).c_str(),
                              _O_RDWR | _O_CREAT | _O_EXCL | _O_TEMPORARY | for_bytes, 0600);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

std::string words_of(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

}  // namespace kinemend::platform
#endif
