// Runs the HTTP server and turns SIGINT and SIGTERM into an orderly end.
#include "view_server.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <string>
#include <thread>
#include <utility>

#include "http_server.hpp"
#include "kinemend/error.hpp"

namespace kinemend::cli {

namespace {

// A signal handler may do little: it writes a byte here.
std::atomic<int> signalled{-1};

void hear(int signal) {
  const char byte = static_cast<char>(signal);
  const int saved = errno;
  [[maybe_unused]] const ssize_t ignored = write(signalled, &byte, 1);
  errno = saved;
}

// While it lives, SIGINT and SIGTERM call `end`, in a thread where anything may be called.
class EndSignals {
 public:
  explicit EndSignals(std::function<void()> end) : end_(std::move(end)) {
    if (pipe2(pipe_.data(), O_CLOEXEC) != 0)
      throw Error(ErrorKind::cannot_write, "view: the system has no pipe left");
    signalled = pipe_[1];
    struct sigaction action {};
    action.sa_handler = hear;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
    waiting_ = std::thread([this] {
      if (next() == 0) return;
      end_();
      // A second signal ends the program without waiting for the run. No file is left half written.
      if (const int signal = next(); signal != 0) _exit(128 + signal);
    });
  }
  ~EndSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    // Wakes the thread where no signal did.
    hear(0);
    waiting_.join();
    for (const int end : pipe_) close(end);
  }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

 private:
  // The next signal; 0 once the wait is over.
  int next() const {
    char byte = 0;
    while (read(pipe_[0], &byte, 1) < 0 && errno == EINTR) {
    }
    return byte;
  }

  static constexpr std::array signals = {SIGINT, SIGTERM};

  std::function<void()> end_;
  std::array<int, 2> pipe_{};
  std::array<struct sigaction, 2> before_{};
  std::thread waiting_;
};

}  // namespace

void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending) {
  HttpServer server(port);
  const ViewAccess access(random_token(), server.port());
  const EndSignals signals([&] {
    ending();
    server.stop();
  });
  started(access.address());
  server.serve(
      [&](const HttpHead& head) {
        return access.refusal(
            {head.method, head.path, head.host, head.origin, head.site, head.type});
      },
      [&](const HttpHead& head, const std::string& body) {
        return answer(head.method, access.action(head.path), body);
      });
}

}  // namespace kinemend::cli
