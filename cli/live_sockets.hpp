#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Sockets of `kinemend stream`: plain POSIX, none of them blocks.
namespace kinemend::cli {

/// A descriptor that is closed with its owner.
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
  std::string host;  ///< empty: none was given
  std::string port;
};
/// Errors: `ErrorKind::usage`, naming the option.
Address parse_address(std::string_view option, std::string_view text);
std::string to_string(const Address& address);

enum class Transport : std::uint8_t { tcp, udp };

/// A socket that takes connections, or datagrams, at this address; port 0 is any that is free.
/// Errors: `ErrorKind::unreadable_input`.
Descriptor listen_at(const Address& address, Transport transport);
/// "127.0.0.1:7001": where a socket is.
std::string place_of(const Descriptor& socket);
/// A connection under way, or an empty descriptor where it failed at once. It is there when the
/// socket can be written to and `connection_error` is 0.
Descriptor begin_connection(const Address& address, Transport transport);
/// The number of the error of a connection under way; 0: none.
int connection_error(const Descriptor& socket);
/// Waits for it. Empty where it failed; `error` then says why.
Descriptor connect_to(const Address& address, Transport transport, std::string& error);
/// The connection of a sender, or an empty descriptor.
Descriptor accept_from(const Descriptor& listener);

}  // namespace kinemend::cli
