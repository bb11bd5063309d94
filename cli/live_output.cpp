// Queues frames for the client, drops the oldest when it does not read, reconnects, and counts
// latencies.
#include "live_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <numeric>

#include "platform/console.hpp"
#include "platform/network.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

constexpr double least_s = 1e-6, buckets_per_factor = 50;  // of e
constexpr std::chrono::seconds between_connections{1};
constexpr std::size_t most_datagram = 60000;

// A part of a header that fits into a datagram, cut at a line end if possible.
std::string_view datagram_of(std::string_view text) {
  if (text.size() <= most_datagram) return text;
  const std::size_t end = text.rfind('\n', most_datagram - 1);
  return text.substr(0, end == text.npos ? most_datagram : end + 1);
}

}  // namespace

void LatencyHistogram::add(double seconds) {
  const double place = std::log(std::max(seconds, least_s) / least_s) * buckets_per_factor;
  ++counts_[std::min(static_cast<std::size_t>(place), buckets - 1)];
  ++count_;
  most_ = std::max(most_, seconds);
}

double LatencyHistogram::quantile_s(double share) const {
  const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count_)));
  std::size_t seen = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    seen += counts_[b];
    if (seen >= std::max<std::size_t>(wanted, 1))
      return std::min(most_,
                      least_s * std::exp((static_cast<double>(b) + 0.5) / buckets_per_factor));
  }
  return most_;
}

std::vector<LatencyHistogram::Bar> LatencyHistogram::bars() const {
  constexpr std::size_t width = 25;
  std::vector<Bar> all;
  for (std::size_t b = 0; b < buckets; b += width) {
    const double below_s = least_s * std::exp(static_cast<double>(b + width) / buckets_per_factor);
    const auto sum = std::accumulate(counts_ + b, counts_ + b + width, std::size_t{0});
    if (sum > 0 || !all.empty()) all.push_back({below_s, sum});
  }
  while (!all.empty() && all.back().count == 0) all.pop_back();
  return all;
}

std::string latency_text(const LatencyHistogram& latency, double delay_ms) {
  return fmt::format(
      "latency: {:.3g} ms median, {:.3g} ms at the 99th percentile, {:.3g} ms maximum, plus "
      "{:.3g} ms of delay",
      1000 * latency.quantile_s(0.5), 1000 * latency.quantile_s(0.99), 1000 * latency.most_s(),
      delay_ms);
}

LiveOutput::LiveOutput(std::size_t most_waiting) : most_waiting_(most_waiting) {
  check_out_is_open();
}

LiveOutput::LiveOutput(const Address& address, Transport transport, std::size_t most_waiting)
    : kind_(transport == Transport::tcp ? Kind::tcp : Kind::udp),
      address_(address),
      most_waiting_(most_waiting) {
  std::string error;
  socket_ = connect_to(address, transport, error);
  if (!socket_)
    throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", to_string(address), error));
}

void LiveOutput::add(bool is_header, std::string_view text,
                     std::optional<LiveClock::time_point> came) {
  if (is_header) header_ = text;
  // A client that reconnects gets the header first, and no frames from before it.
  if (is_header && !is_connected_) return give_up();
  if (drops_ && !is_header && is_full()) drop_oldest();
  if (drops_ && is_header) drop_header_before(waiting_.size());
  waiting_.push_back({is_header, std::string(text), came});
  frames_waiting_ += is_header ? 0 : 1;
}

// Headers are included: a sender of only headers must not fill the memory.
bool LiveOutput::is_full() const {
  return frames_waiting_ >= most_waiting_ || waiting_.size() >= 2 * most_waiting_ + 2;
}

// Drops a header directly before another one at `place`, which no frame uses.
void LiveOutput::drop_header_before(std::size_t place) {
  const std::size_t first = offset_ > 0 ? 1 : 0;
  if (place <= first || !waiting_[place - 1].is_header) return;
  waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(place - 1));
}

// A partly written piece is kept, because its rest must follow.
void LiveOutput::drop_oldest() {
  const auto first = waiting_.begin() + (offset_ > 0 ? 1 : 0);
  const auto frame =
      std::find_if(first, waiting_.end(), [](const Waiting& piece) { return !piece.is_header; });
  if (frame == waiting_.end()) return;
  const auto place = static_cast<std::size_t>(frame - waiting_.begin());
  waiting_.erase(frame);
  --frames_waiting_;
  ++dropped_;
  if (place < waiting_.size() && waiting_[place].is_header) drop_header_before(place);
}

int LiveOutput::descriptor() const {
  if (!is_connected_) return socket_.number();
  if (waiting_.empty()) return -1;
  return kind_ == Kind::standard ? platform::standard_output : socket_.number();
}

std::optional<LiveClock::time_point> LiveOutput::next_attempt() const { return next_attempt_; }

void LiveOutput::try_again() {
  next_attempt_.reset();
  socket_ = begin_connection(address_, Transport::tcp);
  is_connected_ = false;
  if (!socket_) next_attempt_ = LiveClock::now() + between_connections;
}

void LiveOutput::write_some() {
  if (!is_connected_) {
    if (connection_error(socket_) != 0) {
      socket_.close();
      next_attempt_ = LiveClock::now() + between_connections;
      return;
    }
    is_connected_ = true;
    say(fmt::format("{}: the client is connected again", to_string(address_)));
    const bool begins_with_header = !waiting_.empty() && waiting_.front().is_header;
    if (!header_.empty() && !begins_with_header) waiting_.push_front({true, header_, std::nullopt});
    return;
  }
  if (waiting_.empty()) return;
  switch (kind_) {
    case Kind::standard:
      return write_standard();
    case Kind::tcp:
      return write_tcp();
    case Kind::udp:
      return write_udp();
  }
}

void LiveOutput::write_standard() {
  const std::string_view rest = std::string_view(waiting_.front().text).substr(offset_);
  const std::ptrdiff_t count = platform::write_some_out(rest);
  if (count >= 0) {
    offset_ += static_cast<std::size_t>(count);
    if (offset_ == waiting_.front().text.size()) written();
  } else if (errno == EPIPE) {
    throw ClosedPipe();
  } else if (!platform::must_wait(errno)) {
    throw Error(ErrorKind::cannot_write,
                fmt::format("standard output: {}", platform::words_of_error(errno)));
  }
}

void LiveOutput::write_tcp() {
  while (!waiting_.empty()) {
    const std::string_view rest = std::string_view(waiting_.front().text).substr(offset_);
    const std::ptrdiff_t count = platform::send_some(socket_.number(), rest);
    if (count < 0) {
      if (!platform::must_wait(errno)) client_gone();
      return;
    }
    offset_ += static_cast<std::size_t>(count);
    if (offset_ < waiting_.front().text.size()) return;
    written();
  }
}

// Errors are ignored, because no receiver may be listening.
void LiveOutput::write_udp() {
  while (!waiting_.empty()) {
    const std::string_view piece =
        datagram_of(std::string_view(waiting_.front().text).substr(offset_));
    const std::ptrdiff_t count = platform::send_some(socket_.number(), piece);
    if (count < 0 && platform::must_wait(errno)) return;
    offset_ += piece.size();
    if (offset_ == waiting_.front().text.size()) written();
  }
}

void LiveOutput::written() {
  const Waiting& piece = waiting_.front();
  if (!piece.is_header) {
    if (piece.came)
      latency_.add(std::chrono::duration<double>(LiveClock::now() - *piece.came).count());
    --frames_waiting_;
  }
  waiting_.pop_front();
  offset_ = 0;
}

void LiveOutput::client_gone() {
  say(fmt::format("{}: the client disconnected; trying to reconnect", to_string(address_)));
  socket_.close();
  next_attempt_ = LiveClock::now() + between_connections;
  is_connected_ = false;
  offset_ = 0;
  // The last header is sent first when the client reconnects.
  std::erase_if(waiting_, [](const Waiting& piece) { return piece.is_header; });
}

void LiveOutput::give_up() {
  dropped_ += frames_waiting_;
  frames_waiting_ = offset_ = 0;
  waiting_.clear();
}

}  // namespace kinemend::cli
