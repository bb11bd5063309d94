// Sockets of `kinemend stream`, which never block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend::cli {

/// Closes its descriptor in its destructor.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      close();
      number_ = std::exchange(other.number_, -1);
    }
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }  ///< -1: none
  explicit operator bool() const { return number_ >= 0; }
  void close();

 private:
  int number_ = -1;
};

/// `PORT`, `HOST:PORT` or `[HOST]:PORT`.
struct Address {
  std::string host;  ///< empty if not given
  std::string port;
};
/// Errors: `ErrorKind::usage`, naming the option.
Address parse_address(std::string_view option, std::string_view text);
std::string to_string(const Address& address);

enum class Transport : std::uint8_t { tcp, udp };

/// A socket that accepts connections or datagrams at this address; port 0 takes any free port.
/// Errors: `ErrorKind::unreadable_input`.
Descriptor listen_at(const Address& address, Transport transport);
/// The address of a socket: "127.0.0.1:7001".
std::string place_of(const Descriptor& socket);
/// Receives a datagram and the sender's address. Returns -1 if none waits or an earlier one failed.
std::ptrdiff_t receive_datagram(const Descriptor& socket, std::span<char> bytes,
                                std::string& sender);
/// Starts a connection; returns an empty descriptor if that fails at once. The connection is
/// established when the socket can be written to and `connection_error` is 0.
Descriptor begin_connection(const Address& address, Transport transport);
/// The error number of a started connection; 0: none.
int connection_error(const Descriptor& socket);
/// Connects and waits. Returns an empty descriptor on failure; `error` then has the reason.
Descriptor connect_to(const Address& address, Transport transport, std::string& error);
/// Accepts the connection of a sender; an empty descriptor on failure.
Descriptor accept_from(const Descriptor& listener);

}  // namespace kinemend::cli
