// Resolves addresses, and opens, connects and accepts non-blocking sockets.
#include "live_sockets.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "kinemend/error.hpp"
#include "kinemend/experimental/text.hpp"

namespace kinemend::cli {

namespace {

constexpr int connect_timeout_ms = 5000;

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

// Empty if the name is unknown; `error` then has the reason.
Addresses addresses_of(const Address& address, Transport transport, bool passive,
                       std::string& error) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = transport == Transport::tcp ? SOCK_STREAM : SOCK_DGRAM;
  hints.ai_flags = passive ? AI_PASSIVE : 0;
  addrinfo* list = nullptr;
  const char* const host = address.host.empty() ? nullptr : address.host.c_str();
  const int code = getaddrinfo(host, address.port.c_str(), &hints, &list);
  if (code != 0) error = gai_strerror(code);
  return Addresses(code == 0 ? list : nullptr);
}

bool set_up(const Descriptor& socket) {
  const int flags = fcntl(socket.number(), F_GETFL);
  return flags >= 0 && fcntl(socket.number(), F_SETFL, flags | O_NONBLOCK) == 0 &&
         fcntl(socket.number(), F_SETFD, FD_CLOEXEC) == 0;
}

void set_option(const Descriptor& socket, int level, int option) {
  const int on = 1;
  setsockopt(socket.number(), level, option, &on, sizeof on);
}

Descriptor open_socket(const addrinfo& info) {
  Descriptor opened(socket(info.ai_family, info.ai_socktype, info.ai_protocol));
  if (opened && !set_up(opened)) opened.close();
  return opened;
}

}  // namespace

void Descriptor::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

Address parse_address(std::string_view option, std::string_view text) {
  Address address;
  const std::size_t colon = text.rfind(':');
  std::string_view port = text;
  if (colon != text.npos) {
    std::string_view host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (host.size() >= 2 && host.front() == '[' && host.back() == ']')
      host = host.substr(1, host.size() - 2);
    address.host = host;
  }
  unsigned number = 0;
  const auto read = std::from_chars(port.data(), port.data() + port.size(), number);
  if (port.empty() || read.ec != std::errc() || read.ptr != port.data() + port.size() ||
      number > 65535 || (colon != text.npos && address.host.empty())) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: expected PORT or HOST:PORT with a port of 0 to 65535, found {}",
                            option, printable_name(text)));
  }
  address.port = port;
  return address;
}

std::string to_string(const Address& address) {
  return address.host.find(':') == std::string::npos
             ? fmt::format("{}:{}", address.host, address.port)
             : fmt::format("[{}]:{}", address.host, address.port);
}

Descriptor listen_at(const Address& address, Transport transport) {
  std::string error;
  const Addresses list = addresses_of(address, transport, true, error);
  for (const addrinfo* info = list.get(); info != nullptr; info = info->ai_next) {
    Descriptor opened = open_socket(*info);
    if (opened) {
      set_option(opened, SOL_SOCKET, SO_REUSEADDR);
      if (bind(opened.number(), info->ai_addr, info->ai_addrlen) == 0 &&
          (transport == Transport::udp || listen(opened.number(), SOMAXCONN) == 0)) {
        return opened;
      }
    }
    error = std::strerror(errno);
  }
  throw Error(ErrorKind::unreadable_input, fmt::format("{}: {}", to_string(address), error));
}

std::string place_of(const Descriptor& socket) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  if (getsockname(socket.number(), generic, &size) != 0 ||
      getnameinfo(generic, size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "?";
  }
  return to_string(Address{host.data(), port.data()});
}

Descriptor begin_connection(const Address& address, Transport transport) {
  std::string ignored;
  const Addresses list = addresses_of(address, transport, false, ignored);
  for (const addrinfo* info = list.get(); info != nullptr; info = info->ai_next) {
    Descriptor opened = open_socket(*info);
    if (!opened) continue;
    if (transport == Transport::tcp) set_option(opened, IPPROTO_TCP, TCP_NODELAY);
    if (connect(opened.number(), info->ai_addr, info->ai_addrlen) == 0 || errno == EINPROGRESS)
      return opened;
  }
  return {};
}

int connection_error(const Descriptor& socket) {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket.number(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

Descriptor connect_to(const Address& address, Transport transport, std::string& error) {
  const Addresses list = addresses_of(address, transport, false, error);
  for (const addrinfo* info = list.get(); info != nullptr; info = info->ai_next) {
    Descriptor opened = open_socket(*info);
    if (opened && transport == Transport::tcp) set_option(opened, IPPROTO_TCP, TCP_NODELAY);
    const bool begun = opened && (connect(opened.number(), info->ai_addr, info->ai_addrlen) == 0 ||
                                  errno == EINPROGRESS);
    if (!begun) {
      error = std::strerror(errno);
      continue;
    }
    pollfd waiting{opened.number(), POLLOUT, 0};
    int ready = 0;
    do {
      ready = poll(&waiting, 1, connect_timeout_ms);
    } while (ready < 0 && errno == EINTR);
    const int number = ready == 0 ? ETIMEDOUT : connection_error(opened);
    if (number == 0) return opened;
    error = std::strerror(number);
  }
  return {};
}

Descriptor accept_from(const Descriptor& listener) {
  Descriptor accepted(accept(listener.number(), nullptr, nullptr));
  if (accepted && !set_up(accepted)) accepted.close();
  return accepted;
}

}  // namespace kinemend::cli
