// Resolves addresses, and opens, connects and accepts non-blocking sockets.
#include "live_sockets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <memory>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "platform/network.hpp"

namespace kinemend::cli {

namespace {

constexpr int connect_timeout_ms = 5000;

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

// Returns no addresses if the name is unknown; `error` then has the reason.
Addresses addresses_of(const Address& address, Transport transport, bool passive,
                       std::string& error) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = transport == Transport::tcp ? SOCK_STREAM : SOCK_DGRAM;
  hints.ai_flags = passive ? AI_PASSIVE : 0;
  addrinfo* list = nullptr;
  const char* const host = address.host.empty() ? nullptr : address.host.c_str();
  platform::begin_sockets();
  const int code = getaddrinfo(host, address.port.c_str(), &hints, &list);
  if (code != 0) error = gai_strerror(code);
  return Addresses(code == 0 ? list : nullptr);
}

Descriptor open_socket(const addrinfo& info) {
  return Descriptor(platform::open_socket(info.ai_family, info.ai_socktype, info.ai_protocol));
}

// Returns true if the socket is connected or still connecting.
bool connects(const Descriptor& socket, const addrinfo& info, Transport transport) {
  if (!socket) return false;
  if (transport == Transport::tcp) platform::send_at_once(socket.number());
  return platform::connect_socket(socket.number(), info.ai_addr, info.ai_addrlen) ||
         errno == EINPROGRESS;
}

std::string name_of_place(const sockaddr* place, socklen_t size) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (getnameinfo(place, size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "?";
  }
  return to_string(Address{host.data(), port.data()});
}

}  // namespace

void Descriptor::close() {
  if (number_ >= 0) platform::close_socket(number_);
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
      platform::let_address_be_reused(opened.number());
      if (platform::bind_socket(opened.number(), info->ai_addr, info->ai_addrlen) &&
          (transport == Transport::udp || platform::listen_on(opened.number()))) {
        return opened;
      }
    }
    error = platform::words_of_error(errno);
  }
  throw Error(ErrorKind::unreadable_input, fmt::format("{}: {}", to_string(address), error));
}

std::string place_of(const Descriptor& socket) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  return getsockname(socket.number(), generic, &size) == 0 ? name_of_place(generic, size) : "?";
}

std::ptrdiff_t receive_datagram(const Descriptor& socket, std::span<char> bytes,
                                std::string& sender) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  const std::ptrdiff_t count =
      platform::receive_from(socket.number(), bytes.data(), bytes.size(), generic, size);
  if (count >= 0) sender = name_of_place(generic, size);
  return count;
}

Descriptor begin_connection(const Address& address, Transport transport) {
  std::string ignored;
  const Addresses list = addresses_of(address, transport, false, ignored);
  for (const addrinfo* info = list.get(); info != nullptr; info = info->ai_next) {
    Descriptor opened = open_socket(*info);
    if (connects(opened, *info, transport)) return opened;
  }
  return {};
}

int connection_error(const Descriptor& socket) { return platform::socket_error(socket.number()); }

Descriptor connect_to(const Address& address, Transport transport, std::string& error) {
  const Addresses list = addresses_of(address, transport, false, error);
  for (const addrinfo* info = list.get(); info != nullptr; info = info->ai_next) {
    Descriptor opened = open_socket(*info);
    if (!connects(opened, *info, transport)) {
      error = platform::words_of_error(errno);
      continue;
    }
    platform::Awaited waiting{opened.number(), true, false};
    int ready = 0;
    do {
      ready = platform::wait_for({&waiting, 1}, connect_timeout_ms);
    } while (ready < 0 && errno == EINTR);
    const int number = ready == 0 ? ETIMEDOUT : connection_error(opened);
    if (number == 0) return opened;
    error = platform::words_of_error(number);
  }
  return {};
}

Descriptor accept_from(const Descriptor& listener) {
  return Descriptor(platform::accept_socket(listener.number()));
}

}  // namespace kinemend::cli
