// Accepts connections, serves each in a thread with deadlines, and closes the longest waiting one
// when there are too many.
#include "http_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <list>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "kinemend/error.hpp"
#include "platform/network.hpp"

namespace kinemend::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int ok = 200;

std::string_view reason_of(int status) {
  static constexpr std::pair<int, std::string_view> reasons[] = {
      {ok, "OK"},
      {http::bad_request, "Bad Request"},
      {http::forbidden, "Forbidden"},
      {http::not_found, "Not Found"},
      {http::not_allowed, "Method Not Allowed"},
      {http::timed_out, "Request Timeout"},
      {http::length_required, "Length Required"},
      {http::too_large, "Content Too Large"},
      {http::wrong_type, "Unsupported Media Type"},
      {http::head_too_large, "Request Header Fields Too Large"},
      {http::wrong_version, "HTTP Version Not Supported"}};
  const auto* found = std::find_if(std::begin(reasons), std::end(reasons),
                                   [&](const auto& entry) { return entry.first == status; });
  return found != std::end(reasons) ? found->second : status < 500 ? "Refused" : "Failed";
}

std::string head_of(const HttpReply& reply, bool keeps_alive) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: {}\r\n"
      "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\n"
      "Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\r\n",
      reply.status, reason_of(reply.status), reply.type, reply.body.size(),
      keeps_alive ? "keep-alive" : "close");
}

// Waits until the socket can be read or written. Returns false at the deadline or on failure.
bool wait_until(int socket, bool writing, Clock::time_point deadline) {
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    platform::Awaited waited{socket, writing};
    const int ready = platform::wait_for({&waited, 1}, static_cast<int>(left));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

int made_listener(int port) {
  const int listener = platform::open_socket(AF_INET, SOCK_STREAM, 0);
  if (listener < 0) return -1;
  platform::let_address_be_reused(listener);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  if (platform::bind_socket(listener, reinterpret_cast<const sockaddr*>(&place), sizeof place) &&
      platform::listen_on(listener))
    return listener;
  const int reason = errno;
  platform::close_socket(listener);
  errno = reason;
  return -1;
}

}  // namespace

/// Lists the connections and decides which may be closed for a new one.
class HttpServer::Connections {
 public:
  /// The state of a thread. A thread that is answering is not interrupted, even when the server
  /// stops or is full.
  enum class At { waiting, reading, answering };
  struct Entry {
    int socket;
    At at;
    Clock::time_point since;
  };
  using Place = std::list<Entry>::iterator;

  explicit Connections(std::size_t most) : most_(most) {}

  /// Adds a socket. If there are too many, closes the one that has been waiting longest. Returns
  /// nullopt if all of them are being answered or the server stops.
  std::optional<Place> add(int socket) {
    std::unique_lock lock(mutex_);
    if (entries_.size() >= most_ && !close_oldest()) return std::nullopt;
    constexpr std::chrono::seconds soon(1);
    if (!changed_.wait_for(lock, soon, [&] { return entries_.size() < most_; }) || is_stopping_)
      return std::nullopt;
    return entries_.insert(entries_.end(), {socket, At::waiting, Clock::now()});
  }

  void remove(Place place) {
    const std::lock_guard lock(mutex_);
    platform::close_socket(place->socket);
    entries_.erase(place);
    changed_.notify_all();
  }

  void set(Place place, At at) {
    const std::lock_guard lock(mutex_);
    place->at = at;
    place->since = Clock::now();
  }

  bool is_stopping() const {
    const std::lock_guard lock(mutex_);
    return is_stopping_;
  }

  /// Closes the connections that wait for their client.
  void stop() {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
    for (const Entry& entry : entries_) {
      if (entry.at != At::answering) platform::shut_down(entry.socket);
    }
  }

  void wait_until_none() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return entries_.empty(); });
  }

 private:
  bool close_oldest() {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (entry->at == At::waiting && (oldest == entries_.end() || entry->since < oldest->since))
        oldest = entry;
    }
    if (oldest == entries_.end()) return false;
    platform::shut_down(oldest->socket);
    return true;
  }

  std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Entry> entries_;
  bool is_stopping_ = false;
};

/// Handles one connection in its own thread.
class HttpServer::Connection {
 public:
  Connection(const HttpLimits& limits, Connections& all, Connections::Place place,
             const Admit& admit, const Answer& answer)
      : limits_(limits),
        all_(all),
        place_(place),
        socket_(place->socket),
        admit_(admit),
        answer_(answer) {}

  void run() {
    try {
      while (!all_.is_stopping() && serve_one()) all_.set(place_, Connections::At::waiting);
    } catch (const std::exception&) {
      // If memory runs out, this connection ends and the others continue.
    }
  }

 private:
  // Returns whether the connection stays open for another request.
  bool serve_one() {
    const auto deadline = Clock::now() + limits_.head_time;
    std::size_t size = 0;
    while ((size = cli::head_bytes(received_)) == received_.npos) {
      if (received_.size() >= limits_.head_bytes) return refuse(http::head_too_large);
      if (receive(limits_.head_bytes - received_.size(), deadline)) continue;
      // A connection without any request is closed without a reply.
      return !received_.empty() && Clock::now() >= deadline && refuse(http::timed_out);
    }
    const ParsedHead parsed = parse_head(received_.substr(0, size), limits_.body_bytes);
    received_.erase(0, size);
    if (parsed.refusal != 0) return refuse(parsed.refusal);
    const HttpHead& head = parsed.head;
    if (const int refusal = admit_(head); refusal != 0) return refuse(refusal);
    if (head.method != "GET" && head.method != "POST") return refuse(http::not_allowed);
    all_.set(place_, Connections::At::reading);
    if (!read_body(head)) return false;
    std::string body = std::move(received_);
    // Bytes after the body belong to the next request.
    received_ = body.substr(head.body_bytes);
    body.resize(head.body_bytes);
    all_.set(place_, Connections::At::answering);
    const HttpReply reply = answer_(head, body);
    const bool keeps_alive = head.keeps_alive && !all_.is_stopping();
    return send(head_of(reply, keeps_alive)) && send(reply.body) && keeps_alive;
  }

  bool read_body(const HttpHead& head) {
    const auto deadline = Clock::now() + limits_.body_time;
    if (head.expects_continue && received_.size() < head.body_bytes &&
        !send("HTTP/1.1 100 Continue\r\n\r\n"))
      return false;
    while (received_.size() < head.body_bytes) {
      if (!receive(head.body_bytes - received_.size(), deadline))
        return Clock::now() >= deadline && refuse(http::timed_out);
    }
    return true;
  }

  // Appends at most `most` bytes. Returns false at the deadline or if the client has disconnected.
  bool receive(std::size_t most, Clock::time_point deadline) {
    char bytes[16384];
    while (wait_until(socket_, false, deadline)) {
      const std::ptrdiff_t got =
          platform::receive_some(socket_, bytes, std::min(most, sizeof bytes));
      if (got > 0) {
        received_.append(bytes, static_cast<std::size_t>(got));
        return true;
      }
      if (got == 0 || !platform::must_wait(errno)) return false;
    }
    return false;
  }

  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::ptrdiff_t sent = platform::send_some(socket_, bytes);
      if (sent > 0) {
        bytes.remove_prefix(static_cast<std::size_t>(sent));
      } else if (!platform::must_wait(errno) ||
                 !wait_until(socket_, true, Clock::now() + limits_.write_time)) {
        return false;
      }
    }
    return true;
  }

  // Sends the refusal and ends the connection. Discards input for a moment, because a client that
  // is still sending would miss the reply if the socket closed at once. Returns false.
  bool refuse(int status) {
    constexpr std::chrono::seconds moment(1);
    const auto deadline = Clock::now() + moment;
    const HttpReply reply{status, "text/plain", "refused\n"};
    if (!send(head_of(reply, false)) || !send(reply.body)) return false;
    platform::shut_down_writing(socket_);
    received_.clear();
    while (receive(sizeof(char[16384]), deadline)) received_.clear();
    return false;
  }

  const HttpLimits& limits_;
  Connections& all_;
  Connections::Place place_;
  int socket_;
  const Admit& admit_;
  const Answer& answer_;
  std::string received_;
};

HttpServer::HttpServer(int port, HttpLimits limits)
    : limits_(limits),
      listener_(made_listener(port)),
      connections_(std::make_shared<Connections>(limits.connections)) {
  if (listener_ < 0) {
    throw Error(ErrorKind::cannot_write,
                fmt::format("port {} cannot be used: {}; leave --port out to get a free port", port,
                            errno == EACCES ? "it is reserved for the system"
                                            : "another program is using it"));
  }
  if (platform::make_wake_ends(stop_ends_)) return;
  platform::close_socket(listener_);
  throw Error(ErrorKind::cannot_write, "the system has no pipe left");
}

HttpServer::~HttpServer() {
  platform::close_socket(listener_);
  for (const int end : stop_ends_) platform::close_wake_end(end);
}

int HttpServer::port() const {
  sockaddr_in place{};
  socklen_t size = sizeof place;
  getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size);
  return ntohs(place.sin_port);
}

void HttpServer::serve(const Admit& admit, const Answer& answer) {
  while (true) {
    platform::Awaited waited[2] = {{listener_, false}, {stop_ends_[0], false}};
    if (platform::wait_for(waited, -1) < 0 && errno != EINTR) break;
    if (waited[1].is_ready) break;
    const int socket = platform::accept_socket(listener_);
    if (socket < 0) {
      // Without a free descriptor, accepting would fail again at once.
      if (platform::is_out_of_sockets(errno)) platform::wait_for({waited + 1, 1}, 100);
      continue;
    }
    // Replies are written as a whole, so they are sent without delay.
    platform::send_at_once(socket);
    const auto place = connections_->add(socket);
    if (!place) {
      platform::close_socket(socket);
      continue;
    }
    try {
      // The thread may still use the list after the wait for its end.
      std::thread([this, all = connections_, at = *place, &admit, &answer] {
        Connection(limits_, *all, at, admit, answer).run();
        all->remove(at);
      }).detach();
    } catch (const std::system_error&) {
      connections_->remove(*place);
    }
  }
  connections_->stop();
  connections_->wait_until_none();
}

void HttpServer::stop() { platform::wake(stop_ends_[1]); }

}  // namespace kinemend::cli
