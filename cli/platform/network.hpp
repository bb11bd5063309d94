// Sockets, and waiting for sockets, standard streams and signals, for each system.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// A socket is a number of 0 or more on every system. Functions that fail return -1 or false and
// leave the reason in `errno`, with POSIX names on every system.
#ifdef _WIN32
#include <winsock2.h>
#include <ws2tcpip.h>
#else
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#endif

namespace kinemend::cli::platform {

/// Call it before looking up host names; the functions below call it themselves.
void begin_sockets();
/// Opens a non-blocking socket that child processes do not inherit.
int open_socket(int family, int type, int protocol);
void close_socket(int socket);
bool bind_socket(int socket, const sockaddr* address, std::size_t size);
/// Frees an address for the next program as soon as this one ends.
void let_address_be_reused(int socket);
bool listen_on(int socket);
/// Returns true if connected at once; EINPROGRESS means that it is still connecting.
bool connect_socket(int socket, const sockaddr* address, std::size_t size);
/// Accepts a socket with the properties of `open_socket`.
int accept_socket(int listener);
/// Sends small pieces at once.
void send_at_once(int socket);
/// Returns the error of a connecting socket; 0 if it has not failed.
int socket_error(int socket);
/// Shuts down a socket in both directions, or for writing only, which wakes waiting threads.
void shut_down(int socket);
void shut_down_writing(int socket);

std::ptrdiff_t send_some(int socket, std::string_view bytes);
/// Receives from a socket, or from standard input by its number.
std::ptrdiff_t receive_some(int socket, char* bytes, std::size_t most);
/// Receives a datagram and its sender. `size` is the size of the storage, then of the address.
std::ptrdiff_t receive_from(int socket, char* bytes, std::size_t most, sockaddr* sender,
                            socklen_t& size);
/// Writes to standard output as much as possible without waiting, where the system can tell.
std::ptrdiff_t write_some_out(std::string_view bytes);

bool must_wait(int error_number);
/// Returns whether `accept_socket` failed because of too many open files.
bool is_out_of_sockets(int error_number);
/// The text of a socket error.
std::string words_of_error(int error_number);

struct Awaited {
  int number = -1;  ///< socket, standard input or standard output; -1: none
  bool writing = false;
  bool is_ready = false;  ///< result: it can be read or written, or has failed
};
/// Waits until one of them is ready; `timeout_ms` of -1 waits for ever. Returns the number of ready
/// ones, or -1 with EINTR after a signal.
int wait_for(std::span<Awaited> awaited, int timeout_ms);

/// Makes two connected ends: data written to the second is read from the first.
bool make_wake_ends(int ends[2]);
void wake(int end);
void close_wake_end(int end);

/// During its lifetime, a request to end the program (SIGINT, SIGTERM, Ctrl-C) makes `number`
/// readable. A second request ends the program. Errors: `ErrorKind::cannot_write`.
class SignalEnds {
 public:
  SignalEnds();
  ~SignalEnds();
  SignalEnds(const SignalEnds&) = delete;
  SignalEnds& operator=(const SignalEnds&) = delete;

  int number() const { return ends_[0]; }
  /// Returns whether a request has come, and clears it.
  bool take();

 private:
  struct Handlers;
  int ends_[2] = {-1, -1};
  std::unique_ptr<Handlers> before_;
};

}  // namespace kinemend::cli::platform
