// Files, processes and signals of the system.
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

/// Appends the bytes to the file in one write and creates a missing file. Returns 0 or the error
/// number.
int append_to_file(const std::string& path, std::string_view bytes);

/// A unique identity of an existing file, whatever path leads to it: device and file number. Empty
/// if it is not a regular file; nullopt if it does not exist.
std::optional<std::string> file_identity(const std::string& path);

/// During its lifetime, no other thread or process can lock the same place of the same file. On a
/// file system without locks, it has no effect.
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

/// Opens an address with the desktop's default program; returns false if that could not be started.
bool open_in_browser(const std::string& address);
/// The name of the program that opens addresses.
std::string_view browser_opener();

/// During its lifetime, the first request to end the program (SIGINT, SIGTERM, Ctrl-C) is only
/// recorded; a second one ends the program.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  static bool came();
  /// Ends the program as the signal would have done.
  [[noreturn]] static void obey();

 private:
  struct Handlers;
  std::unique_ptr<Handlers> before_;
};

/// During its lifetime, a request to end the program calls `end` in an ordinary thread, where any
/// function may be called. A second request ends the program at once. Errors:
/// `ErrorKind::cannot_write`.
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
