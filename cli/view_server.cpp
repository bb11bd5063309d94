#include "view_server.hpp"

#include <fmt/format.h>

#include "kinemend/error.hpp"

#ifdef KINEMEND_HAS_HTTPLIB

#include <fcntl.h>
#include <httplib.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <string>
#include <thread>
#include <utility>

namespace kinemend::cli {

namespace {

constexpr const char* host = "127.0.0.1";
constexpr std::size_t most_asked = 16 << 20;  // bytes of a request; a long take's gap plan is less

// The library compresses what browsers let it, by Brotli at its slowest: half a second for the page
// of ten seconds of motion, which goes no farther than to this machine. It does not where the
// length is known; but then nothing is sent any more once the server ends, which short words of
// failure shall be.
void send_quickly(ServedReply reply, httplib::Response& response) {
  constexpr std::size_t soon_compressed = 4096;
  if (reply.body.size() < soon_compressed) return response.set_content(reply.body, reply.type);
  const std::size_t size = reply.body.size();
  const std::string type = reply.type;
  response.set_content_provider(
      size, type,
      [body = std::move(reply.body)](std::size_t from, std::size_t count, httplib::DataSink& to) {
        return to.write(body.data() + from, count);
      });
}

void reply_to(const httplib::Request& request, httplib::Response& response,
              const ViewAccess& access, const Answer& answer) {
  const ViewRequest asked{request.method,
                          request.path,
                          request.get_header_value("Host"),
                          request.get_header_value("Origin"),
                          request.get_header_value("Sec-Fetch-Site"),
                          request.get_header_value("Content-Type")};
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.status = access.refusal(asked);
  if (response.status != 0) return response.set_content("refused\n", "text/plain");
  ServedReply reply = answer(request.method, access.action(request.path), request.body);
  response.status = reply.status;
  send_quickly(std::move(reply), response);
}

// Where a signal writes a byte: all that may be done while it is handled.
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
      throw Error(ErrorKind::cannot_write, "view: no pipe can be had");
    signalled = pipe_[1];
    struct sigaction action {};
    action.sa_handler = hear;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
    waiting_ = std::thread([this] {
      if (next() == 0) return;
      end_();
      // Who asks twice does not want to wait for what is under way; no file is left half.
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
  // The signal that comes next; 0: there is none any more.
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

bool has_view_server() { return true; }

void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending) {
  httplib::Server server;
  server.set_payload_max_length(most_asked);
  // The library's own setting would let another process share the port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_keep_alive_timeout(1);
  const int bound =
      port == 0 ? server.bind_to_any_port(host) : (server.bind_to_port(host, port) ? port : -1);
  if (bound <= 0)
    throw Error(ErrorKind::cannot_write,
                fmt::format("view: port {} cannot be had: another program has it, or it is not for "
                            "everybody; without --port one that is free is taken",
                            port));
  const ViewAccess access(random_token(), bound);
  const auto handle = [&](const httplib::Request& request, httplib::Response& response) {
    reply_to(request, response, access, answer);
  };
  server.Get(".*", handle);
  server.Post(".*", handle);
  const EndSignals signals([&] {
    ending();
    server.stop();
  });
  started(access.address());
  server.listen_after_bind();
}

}  // namespace kinemend::cli

#else

namespace kinemend::cli {

bool has_view_server() { return false; }

void serve_view(int /*port*/, const Answer& /*answer*/,
                const std::function<void(const std::string& address)>& /*started*/,
                const std::function<void()>& /*ending*/) {
  throw Error(ErrorKind::usage,
              "view: this kinemend was built without its server (libcpp-httplib-dev); --report "
              "FILE.html of clean, fill and check writes the page as a file");
}

}  // namespace kinemend::cli

#endif
