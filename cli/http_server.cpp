// Accepts connections, serves each in a thread with deadlines, and closes the longest waiting one
// when there are too many. A head is read line by line; everything that two parsers could interpret
// differently is refused before the body is read.
#include "http_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <condition_variable>
#include <list>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "platform/network.hpp"

namespace kinemend::cli {

namespace {

struct ParsedHead {
  int refusal = 0;  ///< status code that refuses the head; 0 if it is accepted
  HttpHead head;
};

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

// Control characters could end a line for one reader and not for another.
bool is_line_of_text(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return c == '\t' || (byte >= 0x20 && byte != 0x7F);
  });
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Removes the first line from `text` and returns it without its line end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

class HeadReader {
 public:
  explicit HeadReader(std::size_t most_body_bytes) : most_body_bytes_(most_body_bytes) {}

  ParsedHead read(std::string_view bytes) {
    read_first_line(take_line(bytes));
    while (parsed_.refusal == 0) {
      const std::string_view line = take_line(bytes);
      if (line.empty()) break;
      read_header(line);
    }
    return std::move(parsed_);
  }

 private:
  void refuse(int status) {
    if (parsed_.refusal == 0) parsed_.refusal = status;
  }

  void read_first_line(std::string_view line) {
    const std::size_t first = line.find(' '), last = line.rfind(' ');
    if (first == line.npos || first == last || !is_line_of_text(line))
      return refuse(http::bad_request);
    const std::string_view target = line.substr(first + 1, last - first - 1);
    const std::string_view version = line.substr(last + 1);
    if (!is_token(line.substr(0, first)) || !target.starts_with('/') ||
        target.find(' ') != target.npos)
      return refuse(http::bad_request);
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
      return refuse(version.starts_with("HTTP/") ? http::wrong_version : http::bad_request);
    parsed_.head.method = line.substr(0, first);
    parsed_.head.path = target.substr(0, target.find('?'));
    parsed_.head.keeps_alive = version == "HTTP/1.1";
  }

  void read_header(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == line.npos || !is_token(line.substr(0, colon)) || !is_line_of_text(line))
      return refuse(http::bad_request);
    const std::string name = lower_case(line.substr(0, colon));
    const std::string_view value = without_blanks(line.substr(colon + 1));
    HttpHead& head = parsed_.head;
    if (name == "host") return put(host_, head.host, value);
    if (name == "origin") return put(origin_, head.origin, value);
    if (name == "sec-fetch-site") return put(site_, head.site, value);
    if (name == "content-type") return put(type_, head.type, value);
    if (name == "content-length") return read_length(value);
    if (name == "transfer-encoding") return refuse(http::length_required);
    if (name == "content-encoding" && lower_case(value) != "identity")
      return refuse(http::wrong_type);
    if (name == "connection") read_connection(lower_case(value));
    if (name == "expect" && lower_case(value) == "100-continue") head.expects_continue = true;
  }

  // Two headers of one name could be read differently elsewhere, so they are refused.
  void put(bool& is_given, std::string& place, std::string_view value) {
    if (is_given) return refuse(http::bad_request);
    is_given = true;
    place = value;
  }

  void read_length(std::string_view value) {
    const char* end = value.data() + value.size();
    const bool is_number = !value.empty() && value.find_first_not_of("0123456789") == value.npos;
    if (!is_number || length_) return refuse(http::bad_request);
    std::size_t length = 0;
    const auto [read, error] = std::from_chars(value.data(), end, length);
    if (error != std::errc() || read != end || length > most_body_bytes_)
      return refuse(http::too_large);
    length_ = length;
    parsed_.head.body_bytes = length;
  }

  void read_connection(std::string_view value) {
    if (value == "close") parsed_.head.keeps_alive = false;
    if (value == "keep-alive") parsed_.head.keeps_alive = true;
  }

  std::size_t most_body_bytes_;
  ParsedHead parsed_;
  std::optional<std::size_t> length_;
  bool host_ = false, origin_ = false, site_ = false, type_ = false;
};

/// Returns the length of a request's head including its empty line; npos if it is incomplete.
std::size_t head_bytes(std::string_view received) {
  // Lines may end with \n alone, so the first form of an empty line ends the head.
  const std::size_t full = received.find("\r\n\r\n"), bare = received.find("\n\n");
  if (full == received.npos && bare == received.npos) return received.npos;
  return full < bare ? full + 4 : bare + 2;
}

/// Parses a head with its empty line. Refuses a malformed first line or header and a repeated
/// header (400), another version (505), a body of unknown length, as `Transfer-Encoding` announces
/// (411), a compressed body (415), and one of more than `most_body_bytes` (413). Never throws.
ParsedHead parse_head(std::string_view bytes, std::size_t most_body_bytes) {
  return HeadReader(most_body_bytes).read(bytes);
}

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
