#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "live_sockets.hpp"

namespace kinemend::cli {

using LiveClock = std::chrono::steady_clock;

/// How long things took, in bounded memory: to within 2 %, from 1 us to 1,000 s.
class LatencyHistogram {
 public:
  void add(double seconds);
  bool empty() const { return count_ == 0; }
  /// `share` 0 to 1: 0.5 is the median.
  double quantile_s(double share) const;
  double most_s() const { return most_; }

 private:
  static constexpr std::size_t buckets = 1100;
  std::size_t counts_[buckets] = {};
  std::size_t count_ = 0;
  double most_ = 0;
};

/// Where cleaned frames go: standard output, or a client. What a client does not take waits, so
/// many frames at most; then the oldest are dropped and counted. A client over TCP that has gone is
/// looked for again, and gets the header once more.
class LiveOutput {
 public:
  /// To standard output.
  explicit LiveOutput(std::size_t most_waiting);
  /// To a client. Errors: `ErrorKind::cannot_write` where it cannot be reached.
  LiveOutput(const Address& address, Transport transport, std::size_t most_waiting);

  /// `came`: when the bytes came in that this is made of.
  void add(bool is_header, std::string_view text, LiveClock::time_point came);
  /// Frames are dropped where more wait than may; else they wait, and whoever adds asks `is_full`.
  void set_dropping(bool drops) { drops_ = drops; }
  bool is_full() const { return frames_waiting_ >= most_waiting_; }
  bool is_empty() const { return waiting_.empty(); }

  /// What to wait for; -1: nothing.
  int descriptor() const;
  /// When to look for the client again.
  std::optional<LiveClock::time_point> next_attempt() const;
  void try_again();
  /// Once the descriptor can be written to. Errors: `ClosedPipe`, `ErrorKind::cannot_write`.
  void write_some();
  /// Nothing more goes out: what waits is dropped.
  void give_up();

  std::size_t dropped() const { return dropped_; }
  const LatencyHistogram& latency() const { return latency_; }

 private:
  struct Waiting {
    bool is_header;
    std::string text;
    LiveClock::time_point came;
  };
  enum class Kind : std::uint8_t { standard, tcp, udp };

  void drop_oldest();
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
  std::size_t offset_ = 0;  ///< of what is written of the first one
  std::string header_;      ///< the last one
  std::size_t dropped_ = 0;
  LatencyHistogram latency_;
};

}  // namespace kinemend::cli
