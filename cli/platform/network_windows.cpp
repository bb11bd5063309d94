// Sockets on Windows. Winsock can wait only for sockets: a thread passes standard input on to a
// socket, and writing to standard output waits.
#ifdef _WIN32
#include "platform/network.hpp"

#include <io.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include "kinemend/error.hpp"
#include "platform/console.hpp"

namespace kinemend::cli::platform {

namespace {

// Socket handles have 32 significant bits.
int number_of(SOCKET socket) { return static_cast<int>(socket); }
SOCKET socket_of(int number) { return static_cast<SOCKET>(number); }

int posix_number(int error) {
  switch (error) {
    case 0:
      return 0;
    case WSAEWOULDBLOCK:
      return EWOULDBLOCK;
    case WSAEMFILE:
      return EMFILE;
    case WSAETIMEDOUT:
      return ETIMEDOUT;
    default: {
      const std::error_code code(error, std::system_category());
      const std::error_condition condition = code.default_error_condition();
      return condition.category() == std::generic_category() ? condition.value() : error;
    }
  }
}

bool fail() {
  errno = posix_number(::WSAGetLastError());
  return false;
}

bool set_up(SOCKET socket) {
  u_long on = 1;
  ::SetHandleInformation(reinterpret_cast<HANDLE>(socket), HANDLE_FLAG_INHERIT, 0);
  return ::ioctlsocket(socket, static_cast<long>(FIONBIO), &on) == 0;
}

int set_up_or_closed(SOCKET socket) {
  if (socket != INVALID_SOCKET && set_up(socket)) return number_of(socket);
  fail();
  if (socket != INVALID_SOCKET) ::closesocket(socket);
  return -1;
}

void switch_on(int socket, int level, int option) {
  const int on = 1;
  ::setsockopt(socket_of(socket), level, option, reinterpret_cast<const char*>(&on), sizeof on);
}

// Passes standard input on to a socket that can be waited for.
class InputRelay {
 public:
  InputRelay() {
    int ends[2] = {-1, -1};
    if (!make_wake_ends(ends)) return;
    number_ = ends[0];
    u_long off = 0;
    ::ioctlsocket(socket_of(ends[1]), static_cast<long>(FIONBIO), &off);
    // The thread may wait for standard input for ever and ends with the program.
    std::thread([end = ends[1]] { pass_on(end); }).detach();
  }
  int number() const { return number_; }

 private:
  static void pass_on(int end) {
    std::array<char, 65536> bytes;
    for (;;) {
      const int count = ::_read(standard_input, bytes.data(), static_cast<unsigned>(bytes.size()));
      if (count <= 0) break;
      for (int sent = 0; sent < count;) {
        const int more = ::send(socket_of(end), bytes.data() + sent, count - sent, 0);
        if (more <= 0) return;
        sent += more;
      }
    }
    close_socket(end);
  }

  int number_ = -1;
};

int input_number() {
  static const InputRelay relay;
  return relay.number();
}

std::atomic<int> wake_end_of_signals{-1};

void tell_signal(int /*signal*/) {
  const int end = wake_end_of_signals;
  if (end >= 0) wake(end);
}

}  // namespace

void begin_sockets() {
  static const bool begun = [] {
    WSADATA data{};
    return ::WSAStartup(MAKEWORD(2, 2), &data) == 0;
  }();
  static_cast<void>(begun);
}

int open_socket(int family, int type, int protocol) {
  begin_sockets();
  return set_up_or_closed(::socket(family, type, protocol));
}

void close_socket(int socket) { ::closesocket(socket_of(socket)); }

bool bind_socket(int socket, const sockaddr* address, std::size_t size) {
  return ::bind(socket_of(socket), address, static_cast<int>(size)) == 0 || fail();
}

// On Windows an address is free at once. SO_REUSEADDR would let two programs share it.
void let_address_be_reused(int socket) { switch_on(socket, SOL_SOCKET, SO_EXCLUSIVEADDRUSE); }

bool listen_on(int socket) { return ::listen(socket_of(socket), SOMAXCONN) == 0 || fail(); }

bool connect_socket(int socket, const sockaddr* address, std::size_t size) {
  if (::connect(socket_of(socket), address, static_cast<int>(size)) == 0) return true;
  fail();
  if (errno == EWOULDBLOCK) errno = EINPROGRESS;
  return false;
}

int accept_socket(int listener) {
  return set_up_or_closed(::accept(socket_of(listener), nullptr, nullptr));
}

void send_at_once(int socket) { switch_on(socket, IPPROTO_TCP, TCP_NODELAY); }

int socket_error(int socket) {
  int error = 0;
  int size = sizeof error;
  if (::getsockopt(socket_of(socket), SOL_SOCKET, SO_ERROR, reinterpret_cast<char*>(&error),
                   &size) != 0)
    error = ::WSAGetLastError();
  return posix_number(error);
}

void shut_down(int socket) { ::shutdown(socket_of(socket), SD_BOTH); }
void shut_down_writing(int socket) { ::shutdown(socket_of(socket), SD_SEND); }

std::ptrdiff_t send_some(int socket, std::string_view bytes) {
  constexpr std::size_t most = std::size_t{1} << 20;
  const int count =
      ::send(socket_of(socket), bytes.data(), static_cast<int>(std::min(bytes.size(), most)), 0);
  if (count < 0) fail();
  return count;
}

std::ptrdiff_t receive_some(int socket, char* bytes, std::size_t most) {
  const int from = socket == standard_input ? input_number() : socket;
  const int count = ::recv(socket_of(from), bytes, static_cast<int>(most), 0);
  if (count < 0) fail();
  return count;
}

std::ptrdiff_t receive_from(int socket, char* bytes, std::size_t most, sockaddr* sender,
                            socklen_t& size) {
  const int count = ::recvfrom(socket_of(socket), bytes, static_cast<int>(most), 0, sender, &size);
  if (count < 0) fail();
  return count;
}

std::ptrdiff_t write_some_out(std::string_view bytes) {
  const int error = write_all(standard_output, bytes);
  errno = error;
  return error == 0 ? static_cast<std::ptrdiff_t>(bytes.size()) : -1;
}

bool must_wait(int error_number) {
  return error_number == EAGAIN || error_number == EWOULDBLOCK || error_number == EINTR;
}

bool is_out_of_sockets(int error_number) { return error_number == EMFILE; }

std::string words_of_error(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

int wait_for(std::span<Awaited> awaited, int timeout_ms) {
  constexpr std::size_t most = 8;
  assert(awaited.size() <= most);
  begin_sockets();
  WSAPOLLFD waits[most];
  std::size_t places[most];
  ULONG used = 0;
  int ready = 0;
  for (std::size_t i = 0; i < awaited.size(); ++i) {
    Awaited& one = awaited[i];
    one.is_ready = one.writing && one.number == standard_output;
    ready += one.is_ready ? 1 : 0;
    if (one.number < 0 || one.is_ready) continue;
    const int number = one.number == standard_input ? input_number() : one.number;
    const int events = one.writing ? POLLWRNORM : POLLRDNORM;
    waits[used] = {socket_of(number), static_cast<SHORT>(events), 0};
    places[used++] = i;
  }
  const int timeout = ready > 0 ? 0 : timeout_ms;
  if (used == 0) {
    if (timeout != 0) ::Sleep(timeout < 0 ? INFINITE : static_cast<DWORD>(timeout));
    return ready;
  }
  const int count = ::WSAPoll(waits, used, timeout);
  if (count < 0) fail();
  for (ULONG i = 0; i < used; ++i) awaited[places[i]].is_ready = waits[i].revents != 0;
  return count < 0 ? count : ready + count;
}

// Windows cannot wait for pipes together with sockets, so this makes two connected sockets.
bool make_wake_ends(int ends[2]) {
  const int listener = open_socket(AF_INET, SOCK_STREAM, 0);
  if (listener < 0) return false;
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  int size = sizeof place;
  ends[0] = ends[1] = -1;
  if (bind_socket(listener, generic, sizeof place) && listen_on(listener) &&
      ::getsockname(socket_of(listener), generic, &size) == 0) {
    ends[1] = open_socket(AF_INET, SOCK_STREAM, 0);
    if (ends[1] >= 0 && (connect_socket(ends[1], generic, sizeof place) || errno == EINPROGRESS)) {
      Awaited waited{listener, false, false};
      constexpr int patience_ms = 5000;
      if (wait_for({&waited, 1}, patience_ms) == 1) ends[0] = accept_socket(listener);
    }
  }
  close_socket(listener);
  if (ends[0] >= 0) return true;
  if (ends[1] >= 0) close_socket(ends[1]);
  return false;
}

void wake(int end) {
  const char byte = 0;
  ::send(socket_of(end), &byte, 1, 0);
}

void close_wake_end(int end) { close_socket(end); }

struct SignalEnds::Handlers {
  void (*interrupt)(int) = nullptr;
  void (*terminate)(int) = nullptr;
};

// A handler runs once; then the signal ends the program.
SignalEnds::SignalEnds() : before_(std::make_unique<Handlers>()) {
  if (!make_wake_ends(ends_)) throw Error(ErrorKind::cannot_write, "the system has no socket left");
  wake_end_of_signals = ends_[1];
  before_->interrupt = std::signal(SIGINT, tell_signal);
  before_->terminate = std::signal(SIGTERM, tell_signal);
}

SignalEnds::~SignalEnds() {
  std::signal(SIGINT, before_->interrupt);
  std::signal(SIGTERM, before_->terminate);
  wake_end_of_signals = -1;
  for (const int end : ends_) close_wake_end(end);
}

bool SignalEnds::take() {
  char byte = 0;
  return receive_some(ends_[0], &byte, 1) == 1;
}

}  // namespace kinemend::cli::platform
#endif
