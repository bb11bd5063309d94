// A small HTTP/1.1 server on 127.0.0.1 for pages of the program. It limits the memory and time that
// a client can use. Debian's cpp-httplib (0.11.4) does not: it has no deadline for a whole request,
// no limit on the length of the first line or the number of headers, and it accepts malformed
// heads.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace kinemend::cli {

namespace http {
inline constexpr int bad_request = 400, forbidden = 403, not_found = 404, not_allowed = 405,
                     timed_out = 408, length_required = 411, too_large = 413, wrong_type = 415,
                     head_too_large = 431, wrong_version = 505;
}  // namespace http

/// The head of an HTTP/1.1 request: its first line and its headers.
struct HttpHead {
  std::string method;  ///< "GET"
  std::string path;    ///< "/TOKEN/run" as sent, without a query
  std::string host;    ///< header Host
  std::string origin;  ///< header Origin; empty if missing
  std::string site;    ///< header Sec-Fetch-Site; empty if missing
  std::string type;    ///< header Content-Type; empty if missing
  std::size_t body_bytes = 0;
  bool keeps_alive = true;  ///< the connection stays open for another request
  bool expects_continue = false;
};

struct HttpLimits {
  std::size_t head_bytes = 16 << 10;
  std::size_t body_bytes = 16 << 20;  ///< more than the gap plan of a long take
  /// Connections at one time. A further one closes the one that has been waiting longest.
  std::size_t connections = 64;
  /// Time from the first wait for a request until its head is complete, and from then until its
  /// body is.
  std::chrono::milliseconds head_time{5000}, body_time{5000};
  /// Time allowed for a client that does not read its reply.
  std::chrono::milliseconds write_time{5000};
};

struct HttpReply {
  int status = 200;
  std::string type, body;
};

class HttpServer {
 public:
  /// Returns the status that refuses a request, or 0. Called after the head is read and before the
  /// body.
  using Admit = std::function<int(const HttpHead&)>;
  /// Called in the thread of each connection.
  using Answer = std::function<HttpReply(const HttpHead&, const std::string& body)>;

  /// Binds a port of 127.0.0.1; 0 takes any free port. Errors: `ErrorKind::cannot_write` if it
  /// cannot be bound.
  explicit HttpServer(int port, HttpLimits limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Serves until `stop` is called, then waits until replies in progress are sent.
  void serve(const Admit& admit, const Answer& answer);
  /// May be called from any thread.
  void stop();

 private:
  class Connections;
  class Connection;

  HttpLimits limits_;
  int listener_ = -1;
  int stop_ends_[2] = {-1, -1};  // a byte written to the second wakes the accepting thread
  std::shared_ptr<Connections> connections_;
};

}  // namespace kinemend::cli
