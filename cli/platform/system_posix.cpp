// Files, processes and signals on POSIX systems.
#ifndef _WIN32
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>

#include "kinemend/error.hpp"
#include "platform/console.hpp"
#include "platform/system.hpp"

extern char** environ;

namespace kinemend::cli::platform {

namespace {

std::atomic<int> stop_signal = 0;

// A signal handler may call few functions; it writes a byte to this descriptor.
std::atomic<int> signalled{-1};

void hear(int signal) {
  const char byte = static_cast<char>(signal);
  const int saved = errno;
  [[maybe_unused]] const ssize_t ignored = ::write(signalled, &byte, 1);
  errno = saved;
}

bool make_pipe(std::array<int, 2>& ends) {
#ifdef __linux__
  return ::pipe2(ends.data(), O_CLOEXEC) == 0;
#else
  if (::pipe(ends.data()) != 0) return false;
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return true;
#endif
}

constexpr std::array end_signals = {SIGINT, SIGTERM};

}  // namespace

int append_to_file(const std::string& path, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  const int error = write_all(file, bytes);
  // Some file systems report a full disk only on close.
  const bool is_closed = ::close(file) == 0;
  return error != 0 || is_closed ? error : errno;
}

std::optional<std::string> file_identity(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return S_ISREG(status.st_mode) ? fmt::format("{}:{}", status.st_dev, status.st_ino) : "";
}

FileLock::FileLock(const std::filesystem::path& path, std::uint64_t place) : place_(place) {
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(place_);
  lock.l_len = 1;
#ifdef F_OFD_SETLKW
  constexpr int wait_for_lock = F_OFD_SETLKW;
#else
  constexpr int wait_for_lock = F_SETLKW;  // locks processes only, not threads
#endif
  while (::fcntl(file_, wait_for_lock, &lock) != 0 && errno == EINTR) {
  }
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

bool process_is_running(int process) { return ::kill(process, 0) == 0 || errno == EPERM; }

std::string_view browser_opener() {
#ifdef __APPLE__
  return "open";
#else
  return "xdg-open";
#endif
}

bool open_in_browser(const std::string& address) {
  // The child that opens the browser is never waited for.
  std::signal(SIGCHLD, SIG_IGN);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t settings;
  posix_spawnattr_init(&settings);
#ifdef POSIX_SPAWN_SETSID
  // The browser outlives this program.
  posix_spawnattr_setflags(&settings, POSIX_SPAWN_SETSID);
#endif
  std::string program(browser_opener()), word = address;
  char* words[] = {program.data(), word.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &files, &settings, words, environ);
  posix_spawnattr_destroy(&settings);
  posix_spawn_file_actions_destroy(&files);
  return failed == 0;
}

struct StopRequest::Handlers {
  struct sigaction old[2] = {};
};

StopRequest::StopRequest() : before_(std::make_unique<Handlers>()) {
  struct sigaction action = {};
  action.sa_handler = [](int number) { stop_signal = number; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &before_->old[0]);
  sigaction(SIGTERM, &action, &before_->old[1]);
}

StopRequest::~StopRequest() {
  sigaction(SIGINT, &before_->old[0], nullptr);
  sigaction(SIGTERM, &before_->old[1], nullptr);
}

bool StopRequest::came() { return stop_signal != 0; }

void StopRequest::obey() {
  const int number = stop_signal;
  std::signal(number, SIG_DFL);
  std::raise(number);
  std::_Exit(128 + number);
}

struct EndSignals::Waiting {
  // Waits for the next signal; returns 0 when the wait is over.
  int next() const {
    char byte = 0;
    while (::read(pipe[0], &byte, 1) < 0 && errno == EINTR) {
    }
    return byte;
  }

  std::function<void()> end;
  std::array<int, 2> pipe{};
  std::array<struct sigaction, 2> before{};
  std::thread thread;
};

EndSignals::EndSignals(std::function<void()> end) : waiting_(std::make_unique<Waiting>()) {
  waiting_->end = std::move(end);
  if (!make_pipe(waiting_->pipe))
    throw Error(ErrorKind::cannot_write, "view: the system has no pipe left");
  signalled = waiting_->pipe[1];
  struct sigaction action {};
  action.sa_handler = hear;
  for (std::size_t i = 0; i < end_signals.size(); ++i)
    sigaction(end_signals[i], &action, &waiting_->before[i]);
  waiting_->thread = std::thread([waiting = waiting_.get()] {
    if (waiting->next() == 0) return;
    waiting->end();
    // A second signal ends the program without waiting for the run. No file is left half written.
    if (const int signal = waiting->next(); signal != 0) ::_exit(128 + signal);
  });
}

EndSignals::~EndSignals() {
  for (std::size_t i = 0; i < end_signals.size(); ++i)
    sigaction(end_signals[i], &waiting_->before[i], nullptr);
  // Wakes the thread if no signal did.
  hear(0);
  waiting_->thread.join();
  for (const int end : waiting_->pipe) ::close(end);
}

}  // namespace kinemend::cli::platform
#endif
