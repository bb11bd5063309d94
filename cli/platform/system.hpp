// Files, processes and signals, as the system has them.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace kinemend::cli::platform {

/// Appends the bytes to the file in one piece, and creates the file if it is missing. Returns 0, or
/// the number of the error.
int append_to_file(const std::string& path, std::string_view bytes);

/// The one name of an existing file, whatever path leads to it: its number on its device. Empty for
/// what is no regular file; none where nothing exists.
std::optional<std::string> file_identity(const std::string& path);

/// While it lives, no other thread or process has a lock on the same place of the same file. On a
/// file system without locks nothing is locked.
class FileLock {
 public:
  FileLock(const std::filesystem::path& path, std::uint64_t place);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_ = -1;
  std::uint64_t place_ = 0;
};

bool process_is_running(int process);

/// Opens an address with the desktop's own program; false where it could not be started.
bool open_in_browser(const std::string& address);
/// The name of that program.
std::string_view browser_opener();

/// While it lives, the first request to end the program (SIGINT, SIGTERM, Ctrl-C) is only noted; a
/// second one ends it.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  static bool came();
  /// Ends the program as the signal would have.
  [[noreturn]] static void obey();

 private:
  struct Handlers;
  std::unique_ptr<Handlers> before_;
};

/// While it lives, a request to end the program calls `end`, in a thread where anything may be
/// called. A second one ends the program at once. Errors: `ErrorKind::cannot_write`.
class EndSignals {
 public:
  explicit EndSignals(std::function<void()> end);
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

 private:
  struct Waiting;
  std::unique_ptr<Waiting> waiting_;
};

}  // namespace kinemend::cli::platform
