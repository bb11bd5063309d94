// Sockets on POSIX systems.
#ifndef _WIN32
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <climits>
#include <cstring>

#include "kinemend/error.hpp"
#include "platform/network.hpp"

namespace kinemend::cli::platform {

namespace {

#ifdef MSG_NOSIGNAL
constexpr int send_flags = MSG_NOSIGNAL;
#else
constexpr int send_flags = 0;
#endif

bool set_up(int socket) {
  const int flags = ::fcntl(socket, F_GETFL);
  return flags >= 0 && ::fcntl(socket, F_SETFL, flags | O_NONBLOCK) == 0 &&
         ::fcntl(socket, F_SETFD, FD_CLOEXEC) == 0;
}

// Returns the socket, or -1 after closing it.
int set_up_or_closed(int socket) {
  if (socket < 0 || set_up(socket)) return socket;
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

void switch_on(int socket, int level, int option) {
  const int on = 1;
  ::setsockopt(socket, level, option, &on, sizeof on);
}

int wake_end_of_signals = -1;

extern "C" void tell_signal(int /*signal*/) {
  const int error = errno;
  wake(wake_end_of_signals);
  errno = error;
}

}  // namespace

void begin_sockets() {}

int open_socket(int family, int type, int protocol) {
  return set_up_or_closed(::socket(family, type, protocol));
}

void close_socket(int socket) { ::close(socket); }

bool bind_socket(int socket, const sockaddr* address, std::size_t size) {
  return ::bind(socket, address, static_cast<socklen_t>(size)) == 0;
}

void let_address_be_reused(int socket) { switch_on(socket, SOL_SOCKET, SO_REUSEADDR); }

bool listen_on(int socket) { return ::listen(socket, SOMAXCONN) == 0; }

bool connect_socket(int socket, const sockaddr* address, std::size_t size) {
  return ::connect(socket, address, static_cast<socklen_t>(size)) == 0;
}

int accept_socket(int listener) { return set_up_or_closed(::accept(listener, nullptr, nullptr)); }

void send_at_once(int socket) { switch_on(socket, IPPROTO_TCP, TCP_NODELAY); }

int socket_error(int socket) {
  int error = 0;
  socklen_t size = sizeof error;
  return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

void shut_down(int socket) { ::shutdown(socket, SHUT_RDWR); }
void shut_down_writing(int socket) { ::shutdown(socket, SHUT_WR); }

std::ptrdiff_t send_some(int socket, std::string_view bytes) {
  return ::send(socket, bytes.data(), bytes.size(), send_flags);
}

std::ptrdiff_t receive_some(int socket, char* bytes, std::size_t most) {
  return ::read(socket, bytes, most);
}

std::ptrdiff_t receive_from(int socket, char* bytes, std::size_t most, sockaddr* sender,
                            socklen_t& size) {
  return ::recvfrom(socket, bytes, most, 0, sender, &size);
}

// A writable pipe takes PIPE_BUF bytes without waiting for its reader.
std::ptrdiff_t write_some_out(std::string_view bytes) {
  return ::write(STDOUT_FILENO, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
}

bool must_wait(int error_number) {
  return error_number == EAGAIN || error_number == EWOULDBLOCK || error_number == EINTR;
}

bool is_out_of_sockets(int error_number) {
  return error_number == EMFILE || error_number == ENFILE;
}

std::string words_of_error(int error_number) { return std::strerror(error_number); }

int wait_for(std::span<Awaited> awaited, int timeout_ms) {
  constexpr std::size_t most = 8;
  assert(awaited.size() <= most);
  pollfd waits[most];
  for (std::size_t i = 0; i < awaited.size(); ++i) {
    const int events = awaited[i].writing ? POLLOUT : POLLIN;
    waits[i] = {awaited[i].number, static_cast<short>(events), 0};
  }
  const int count = ::poll(waits, static_cast<nfds_t>(awaited.size()), timeout_ms);
  for (std::size_t i = 0; i < awaited.size(); ++i) awaited[i].is_ready = waits[i].revents != 0;
  return count;
}

bool make_wake_ends(int ends[2]) {
#ifdef __linux__
  if (::pipe2(ends, O_CLOEXEC) != 0) return false;
#else
  if (::pipe(ends) != 0) return false;
  for (const int end : {ends[0], ends[1]}) ::fcntl(end, F_SETFD, FD_CLOEXEC);
#endif
  return true;
}

void wake(int end) {
  const char byte = 0;
  [[maybe_unused]] const ssize_t ignored = ::write(end, &byte, 1);
}

void close_wake_end(int end) { ::close(end); }

struct SignalEnds::Handlers {
  struct sigaction old[2] = {};  // for SIGINT and SIGTERM
};

SignalEnds::SignalEnds() : before_(std::make_unique<Handlers>()) {
  if (!make_wake_ends(ends_)) throw Error(ErrorKind::cannot_write, std::strerror(errno));
  ::fcntl(ends_[1], F_SETFL, O_NONBLOCK);
  wake_end_of_signals = ends_[1];
  struct sigaction action {};
  action.sa_handler = tell_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &before_->old[0]);
  sigaction(SIGTERM, &action, &before_->old[1]);
}

SignalEnds::~SignalEnds() {
  sigaction(SIGINT, &before_->old[0], nullptr);
  sigaction(SIGTERM, &before_->old[1], nullptr);
  wake_end_of_signals = -1;
  for (const int end : ends_) close_wake_end(end);
}

bool SignalEnds::take() {
  char byte = 0;
  return ::read(ends_[0], &byte, 1) == 1;
}

}  // namespace kinemend::cli::platform
#endif
