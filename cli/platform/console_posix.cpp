// Standard streams on POSIX systems.
#ifndef _WIN32
#include <fcntl.h>
#include <sys/utsname.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "platform/console.hpp"

namespace kinemend::cli::platform {

std::vector<std::string> program_words(int argc, char** argv) { return {argv + 1, argv + argc}; }

bool open_standard_streams() {
  const bool out_was_open = ::fcntl(STDOUT_FILENO, F_GETFD) != -1;
  int opened = -1;
  do {
    opened = ::open("/dev/null", O_RDWR);
  } while (opened >= 0 && opened <= STDERR_FILENO);
  if (opened > STDERR_FILENO) ::close(opened);
  return out_was_open;
}

void ignore_closed_pipes() { std::signal(SIGPIPE, SIG_IGN); }

// Cleaning allocates and frees hundreds of tracks. Memory returned to the system each time would
// have to be mapped again page by page.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int largest_kept = 8 << 20, most_kept = 64 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, largest_kept);
  mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

bool is_terminal(int stream) { return ::isatty(stream) != 0; }

bool understands_colours(int stream) {
  const char* terminal = std::getenv("TERM");
  return is_terminal(stream) && terminal != nullptr && std::strcmp(terminal, "dumb") != 0;
}

int write_all(int stream, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(stream, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

SystemNames system_names() {
  utsname machine{};
  if (::uname(&machine) != 0) return {};
  return {machine.sysname, machine.machine};
}

}  // namespace kinemend::cli::platform
#endif
