// Runs the program in the background and talks to it over sockets. No function here reads a clock:
// a missing answer is awaited until the test program's time limit.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "program.hpp"

namespace kinemend::test {

/// Collects the bytes that arrive at a descriptor.
class Incoming {
 public:
  explicit Incoming(int descriptor) : descriptor_(descriptor) {}

  /// Reads until the text holds `part` at least `times` times, or to its end, and returns it.
  const std::string& until(std::string_view part, std::size_t times = 1) {
    while (count(part) < times && more()) {
    }
    return text_;
  }
  const std::string& all() {
    while (more()) {
    }
    return text_;
  }

 private:
  bool more() {
    char bytes[65536];
    const ssize_t got = ::read(descriptor_, bytes, sizeof bytes);
    if (got > 0) text_.append(bytes, static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);
  }
  std::size_t count(std::string_view part) const {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text_.find(part, at)) != text_.npos; at += part.size()) ++found;
    return found;
  }

  int descriptor_;
  std::string text_;
};

inline sockaddr_in loopback(int port) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  return place;
}

/// A socket of this machine that closes in its destructor.
class Socket {
 public:
  explicit Socket(int number) : number_(number) {}
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Socket() { close(); }

  static Socket listening(int type) {
    Socket made(::socket(AF_INET, type, 0));
    sockaddr_in place = loopback(0);
    EXPECT_EQ(::bind(made.number_, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
    if (type == SOCK_STREAM) {
      EXPECT_EQ(::listen(made.number_, 1), 0);
    }
    return made;
  }
  static Socket connected(int type, int port) {
    Socket made(::socket(AF_INET, type, 0));
    sockaddr_in place = loopback(port);
    EXPECT_EQ(::connect(made.number_, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
    return made;
  }

  int port() const {
    sockaddr_in place{};
    socklen_t size = sizeof place;
    ::getsockname(number_, reinterpret_cast<sockaddr*>(&place), &size);
    return ntohs(place.sin_port);
  }
  std::string at() const { return "127.0.0.1:" + std::to_string(port()); }
  Socket accept() const { return Socket(::accept(number_, nullptr, nullptr)); }
  void send(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t sent = ::send(number_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno != EINTR) return;
      if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  std::string datagram() const {
    std::string text(65536, ' ');
    const ssize_t got = ::recv(number_, text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return text;
  }
  Incoming incoming() const { return Incoming(number_); }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// The running program with pipes for its standard streams.
class Running {
 public:
  /// `start` runs the program; it does not return.
  template <class Start>
  explicit Running(const Start& start) {
    int in_ends[2], out_ends[2], err_ends[2];
    if (::pipe(in_ends) != 0 || ::pipe(out_ends) != 0 || ::pipe(err_ends) != 0)
      throw std::runtime_error("no pipe");
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(in_ends[0], STDIN_FILENO);
      ::dup2(out_ends[1], STDOUT_FILENO);
      ::dup2(err_ends[1], STDERR_FILENO);
      for (const int* ends : {in_ends, out_ends, err_ends}) ::close(ends[0]), ::close(ends[1]);
      start();
    }
    for (const int end : {in_ends[0], out_ends[1], err_ends[1]}) ::close(end);
    in_ = in_ends[1], out_ = out_ends[0], err_ = err_ends[0];
    for (const int end : {in_, out_, err_}) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    out = Incoming(out_);
    err = Incoming(err_);
  }
  ~Running() {
    if (!ended_) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    for (const int end : {in_, out_, err_}) {
      if (end >= 0) ::close(end);
    }
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(in_, text.data(), text.size());
      if (count < 0 && errno != EINTR) return;
      if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  void close_in() {
    if (in_ >= 0) ::close(in_);
    in_ = -1;
  }
  void close_out() {
    ::close(out_);
    out_ = -1;
  }
  void tell(int signal) const { ::kill(child_, signal); }
  pid_t process() const { return child_; }
  /// The port that the program prints.
  int port() {
    const std::string& text = err.until(" (");
    return std::stoi(text.substr(text.find("127.0.0.1:") + 10));
  }
  /// Returns the exit code, or 128 + signal if a signal ended the program.
  int wait() {
    int status = 0;
    rusage usage{};
    ::wait4(child_, &status, 0, &usage);
    peak_kilobytes = usage.ru_maxrss;
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  Incoming out{-1}, err{-1};
  long peak_kilobytes = 0;  ///< set when it has ended

 private:
  pid_t child_ = -1;
  int in_ = -1, out_ = -1, err_ = -1;
  bool ended_ = false;
};

}  // namespace kinemend::test
