// Files, processes and signals on Windows.
#ifdef _WIN32
#include <fmt/format.h>
#include <windows.h>
// This header needs windows.h before it.
#include <shellapi.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>

#include "kinemend/error.hpp"
#include "platform/system.hpp"
#include "platform/windows_text.hpp"

namespace kinemend::cli::platform {

namespace {

std::atomic<int> stop_signal = 0;

void note_stop(int number) { stop_signal = number; }

// Event by which the console's thread wakes the thread that ends the program.
std::atomic<HANDLE> end_event{nullptr};

BOOL WINAPI hear(DWORD kind) {
  const HANDLE event = end_event;
  if (event == nullptr || (kind != CTRL_C_EVENT && kind != CTRL_BREAK_EVENT)) return FALSE;
  ::SetEvent(event);
  return TRUE;
}

int last_error_number() {
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  const std::error_condition condition = code.default_error_condition();
  return condition.category() == std::generic_category() ? condition.value() : EIO;
}

HANDLE opened(const std::filesystem::path& path, DWORD access, DWORD disposition) {
  return ::CreateFileW(path.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                       nullptr, disposition, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
}

OVERLAPPED at(std::uint64_t place) {
  OVERLAPPED where{};
  where.Offset = static_cast<DWORD>(place);
  where.OffsetHigh = static_cast<DWORD>(place >> 32);
  return where;
}

}  // namespace

int append_to_file(const std::string& path, std::string_view bytes) {
  const HANDLE file = opened(std::filesystem::path(path), FILE_APPEND_DATA, OPEN_ALWAYS);
  if (file == INVALID_HANDLE_VALUE) return last_error_number();
  DWORD count = 0;
  const bool written =
      ::WriteFile(file, bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr) != 0;
  const int error = written ? EIO : last_error_number();
  ::CloseHandle(file);
  return written && count == bytes.size() ? 0 : error;
}

std::optional<std::string> file_identity(const std::string& path) {
  const HANDLE file = opened(std::filesystem::path(path), FILE_READ_ATTRIBUTES, OPEN_EXISTING);
  if (file == INVALID_HANDLE_VALUE) return std::nullopt;
  BY_HANDLE_FILE_INFORMATION info{};
  const bool is_known = ::GetFileType(file) == FILE_TYPE_DISK &&
                        ::GetFileInformationByHandle(file, &info) != 0 &&
                        (info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
  ::CloseHandle(file);
  if (!is_known) return "";
  return fmt::format("{}:{}:{}", info.dwVolumeSerialNumber, info.nFileIndexHigh,
                     info.nFileIndexLow);
}

// The file number is the handle, which has 32 significant bits.
FileLock::FileLock(const std::filesystem::path& path, std::uint64_t place) : place_(place) {
  const HANDLE file = opened(path, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS);
  if (file == INVALID_HANDLE_VALUE) return;
  file_ = static_cast<int>(reinterpret_cast<std::intptr_t>(file));
  OVERLAPPED where = at(place_);
  ::LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK, 0, 1, 0, &where);
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  const auto file = reinterpret_cast<HANDLE>(static_cast<std::intptr_t>(file_));
  OVERLAPPED where = at(place_);
  ::UnlockFileEx(file, 0, 1, 0, &where);
  ::CloseHandle(file);
}

bool process_is_running(int process) {
  const HANDLE handle =
      ::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(process));
  if (handle == nullptr) return ::GetLastError() == ERROR_ACCESS_DENIED;
  DWORD code = 0;
  const bool runs = ::GetExitCodeProcess(handle, &code) != 0 && code == STILL_ACTIVE;
  ::CloseHandle(handle);
  return runs;
}

std::string_view browser_opener() { return "the browser"; }

bool open_in_browser(const std::string& address) {
  constexpr std::intptr_t last_failure = 32;
  const auto result =
      ::ShellExecuteW(nullptr, L"open", wide_of(address).c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  return reinterpret_cast<std::intptr_t>(result) > last_failure;
}

struct StopRequest::Handlers {
  void (*interrupt)(int) = nullptr;
  void (*terminate)(int) = nullptr;
};

// A handler runs once; then the signal ends the program.
StopRequest::StopRequest() : before_(std::make_unique<Handlers>()) {
  before_->interrupt = std::signal(SIGINT, note_stop);
  before_->terminate = std::signal(SIGTERM, note_stop);
}

StopRequest::~StopRequest() {
  std::signal(SIGINT, before_->interrupt);
  std::signal(SIGTERM, before_->terminate);
}

bool StopRequest::came() { return stop_signal != 0; }

void StopRequest::obey() { std::_Exit(128 + stop_signal); }

struct EndSignals::Waiting {
  // Returns false when the wait is over.
  bool next() const {
    ::WaitForSingleObject(event, INFINITE);
    return !is_over;
  }

  std::function<void()> end;
  HANDLE event = nullptr;
  std::atomic<bool> is_over{false};
  std::thread thread;
};

EndSignals::EndSignals(std::function<void()> end) : waiting_(std::make_unique<Waiting>()) {
  waiting_->end = std::move(end);
  waiting_->event = ::CreateEventW(nullptr, FALSE, FALSE, nullptr);
  if (waiting_->event == nullptr)
    throw Error(ErrorKind::cannot_write, "view: the system has no event left");
  end_event = waiting_->event;
  ::SetConsoleCtrlHandler(hear, TRUE);
  waiting_->thread = std::thread([waiting = waiting_.get()] {
    if (!waiting->next()) return;
    waiting->end();
    if (waiting->next()) std::_Exit(128 + SIGINT);
  });
}

EndSignals::~EndSignals() {
  ::SetConsoleCtrlHandler(hear, FALSE);
  end_event = nullptr;
  waiting_->is_over = true;
  ::SetEvent(waiting_->event);
  waiting_->thread.join();
  ::CloseHandle(waiting_->event);
}

}  // namespace kinemend::cli::platform
#endif
