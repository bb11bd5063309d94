// Sends the cleaned frames of a stream to standard output or a client, and measures their latency.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "live_sockets.hpp"

namespace kinemend::cli {

using LiveClock = std::chrono::steady_clock;

/// A histogram of durations in bounded memory: to within 2 %, from 1 us to 1,000 s.
class LatencyHistogram {
 public:
  void add(double seconds);
  bool empty() const { return count_ == 0; }
  /// `share` 0 to 1: 0.5 is the median.
  double quantile_s(double share) const;
  double most_s() const { return most_; }

  struct Bar {
    double below_s = 0;
    std::size_t count = 0;
  };
  /// Bars of a constant factor in time, from the first non-empty one to the last.
  std::vector<Bar> bars() const;

 private:
  static constexpr std::size_t buckets = 1100;
  std::size_t counts_[buckets] = {};
  std::size_t count_ = 0;
  double most_ = 0;
};

/// "latency: 0.1 ms median, ...", for a stream with a constant delay.
std::string latency_text(const LatencyHistogram& latency, double delay_ms);

/// Sends cleaned frames to standard output or a client. A limited number of frames waits for a
/// client that does not read; then the oldest are dropped and counted. If a TCP client disconnects,
/// the output connects again and sends the header first.
class LiveOutput {
 public:
  /// To standard output.
  explicit LiveOutput(std::size_t most_waiting);
  /// To a client. Errors: `ErrorKind::cannot_write` if it cannot be reached.
  LiveOutput(const Address& address, Transport transport, std::size_t most_waiting);

  /// `came` is the arrival time of the input of this piece; it is empty for the last frames of a
  /// stream, whose latency is not counted because they waited for the end.
  void add(bool is_header, std::string_view text, std::optional<LiveClock::time_point> came);
  /// Whether to drop frames when too many wait. If not, the caller asks `is_full` before it adds.
  void set_dropping(bool drops) { drops_ = drops; }
  bool is_full() const;
  bool is_empty() const { return waiting_.empty(); }

  /// The descriptor to wait for; -1: none.
  int descriptor() const;
  /// The time to try the client again.
  std::optional<LiveClock::time_point> next_attempt() const;
  void try_again();
  /// Call it when the descriptor is writable. Errors: `ClosedPipe`, `ErrorKind::cannot_write`.
  void write_some();
  /// Drops all waiting pieces.
  void give_up();

  std::size_t dropped() const { return dropped_; }
  const LatencyHistogram& latency() const { return latency_; }

 private:
  struct Waiting {
    bool is_header;
    std::string text;
    std::optional<LiveClock::time_point> came;
  };
  enum class Kind : std::uint8_t { standard, tcp, udp };

  void drop_oldest();
  void drop_header_before(std::size_t place);
  void written();
  void client_gone();
  void write_standard();
  void write_tcp();
  void write_udp();

  Kind kind_ = Kind::standard;
  Address address_;
  Descriptor socket_;
  bool is_connected_ = true;
  std::optional<LiveClock::time_point> next_attempt_;
  std::size_t most_waiting_;
  bool drops_ = true;
  std::deque<Waiting> waiting_;
  std::size_t frames_waiting_ = 0;
  std::size_t offset_ = 0;  ///< written bytes of the first piece
  std::string header_;      ///< the latest header
  std::size_t dropped_ = 0;
  LatencyHistogram latency_;
};

}  // namespace kinemend::cli
