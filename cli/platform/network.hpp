// Sockets, and waiting for them, for the standard streams and for signals, as the system has them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// A socket is a number of 0 or more on every system. Functions that fail return -1 or false and
// leave the reason in `errno`, with the names of POSIX on every system.
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

/// Has to be called before names of hosts are looked up; the functions below call it themselves.
void begin_sockets();
/// A new socket that never blocks and that no child process inherits.
int open_socket(int family, int type, int protocol);
void close_socket(int socket);
bool bind_socket(int socket, const sockaddr* address, std::size_t size);
/// Makes an address free for the next program as soon as this one has ended.
void let_address_be_reused(int socket);
bool listen_on(int socket);
/// True if connected at once; EINPROGRESS: it goes on.
bool connect_socket(int socket, const sockaddr* address, std::size_t size);
/// Like `open_socket`'s.
int accept_socket(int listener);
/// Small pieces leave at once.
void send_at_once(int socket);
/// The error of a socket whose connection goes on; 0: none.
int socket_error(int socket);
/// Ends what waits for the socket, in both directions or in that of writing.
void shut_down(int socket);
void shut_down_writing(int socket);

std::ptrdiff_t send_some(int socket, std::string_view bytes);
/// Also from standard input, by its number.
std::ptrdiff_t receive_some(int socket, char* bytes, std::size_t most);
/// A datagram and its sender. `size`: of the storage, then of the address.
std::ptrdiff_t receive_from(int socket, char* bytes, std::size_t most, sockaddr* sender,
                            socklen_t& size);
/// Writes to standard output what can be written without waiting where the system can tell.
std::ptrdiff_t write_some_out(std::string_view bytes);

bool must_wait(int error_number);
/// Whether `accept_socket` failed because there are too many open files.
bool is_out_of_sockets(int error_number);
/// What an error of sockets is called.
std::string words_of_error(int error_number);

struct Awaited {
  int number = -1;  ///< of a socket, of standard input or of standard output; -1: none
  bool writing = false;
  bool is_ready = false;  ///< set: it can be read or written, or has failed
};
/// Waits until one of them is ready. -1: for ever. Returns how many are ready; -1 with EINTR after
/// a signal.
int wait_for(std::span<Awaited> awaited, int timeout_ms);

/// Two connected ends: what is written to the second is read from the first.
bool make_wake_ends(int ends[2]);
void wake(int end);
void close_wake_end(int end);

/// While it lives, requests to end the program (SIGINT, SIGTERM, Ctrl-C) make `number` readable.
/// The same once more ends the program. Errors: `ErrorKind::cannot_write`.
class SignalEnds {
 public:
  SignalEnds();
  ~SignalEnds();
  SignalEnds(const SignalEnds&) = delete;
  SignalEnds& operator=(const SignalEnds&) = delete;

  int number() const { return ends_[0]; }
  /// Whether a request has come, which is then over.
  bool take();

 private:
  struct Handlers;
  int ends_[2] = {-1, -1};
  std::unique_ptr<Handlers> before_;
};

}  // namespace kinemend::cli::platform
