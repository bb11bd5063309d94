// A small HTTP/1.1 server on 127.0.0.1 for pages of the program; it bounds what any client can make
// it store and how long it waits.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "http_head.hpp"

namespace kinemend::cli {

struct HttpLimits {
  std::size_t head_bytes = 16 << 10;
  std::size_t body_bytes = 16 << 20;  ///< the gap plan of a long take is less
  /// Connections at one time. For one more, the one that has kept its thread waiting for a request
  /// longest is closed.
  std::size_t connections = 64;
  /// From the first wait for a request until its head is there, and from then until its body is.
  std::chrono::milliseconds head_time{5000}, body_time{5000};
  /// For a client that takes no byte of an answer.
  std::chrono::milliseconds write_time{5000};
};

struct HttpReply {
  int status = 200;
  std::string type, body;
};

class HttpServer {
 public:
  /// The status that refuses a request, or 0: asked when its head is there, before its body is
  /// read.
  using Admit = std::function<int(const HttpHead&)>;
  /// Called from a thread of each connection.
  using Answer = std::function<HttpReply(const HttpHead&, const std::string& body)>;

  /// Binds a port of 127.0.0.1; 0: any that is free. Errors: `ErrorKind::cannot_write` for one that
  /// cannot be bound.
  explicit HttpServer(int port, HttpLimits limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Serves until `stop` is called, then waits until what was being answered is sent.
  void serve(const Admit& admit, const Answer& answer);
  /// May be called from any thread.
  void stop();

 private:
  class Connections;
  class Connection;

  HttpLimits limits_;
  int listener_ = -1;
  int stop_ends_[2] = {-1, -1};  // a byte in the second wakes the thread that accepts
  std::shared_ptr<Connections> connections_;
};

}  // namespace kinemend::cli
