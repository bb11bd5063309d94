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
  /// Bars of equal factors of time, from the first that is not empty to the last.
  std::vector<Bar> bars() const;

 private:
  static constexpr std::size_t buckets = 1100;
  std::size_t counts_[buckets] = {};
  std::size_t count_ = 0;
  double most_ = 0;
};

/// Where cleaned frames go: standard output or a client. A limited number of frames waits for a
/// client that does not read; then the oldest are dropped and counted. If a client over TCP
/// disconnects, the output connects again and sends the header first.
class LiveOutput {
 public:
  /// To standard output.
  explicit LiveOutput(std::size_t most_waiting);
  /// To a client. Errors: `ErrorKind::cannot_write` where it cannot be reached.
  LiveOutput(const Address& address, Transport transport, std::size_t most_waiting);

  /// `came`: when the bytes arrived that made this piece. None for the last frames of a stream,
  /// which waited for its end: their latency is not counted.
  void add(bool is_header, std::string_view text, std::optional<LiveClock::time_point> came);
  /// Whether to drop frames when too many wait. If not, the caller asks `is_full` before it adds.
  void set_dropping(bool drops) { drops_ = drops; }
  bool is_full() const;
  bool is_empty() const { return waiting_.empty(); }

  /// The descriptor to wait for; -1: none.
  int descriptor() const;
  /// When to try the client again.
  std::optional<LiveClock::time_point> next_attempt() const;
  void try_again();
  /// To be called when the descriptor can be written to. Errors: `ClosedPipe`,
  /// `ErrorKind::cannot_write`.
  void write_some();
  /// Drops everything that waits.
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
  std::size_t offset_ = 0;  ///< bytes of the first piece that are written
  std::string header_;      ///< the last one
  std::size_t dropped_ = 0;
  LatencyHistogram latency_;
};

}  // namespace kinemend::cli
