// Waits for input, output, silence and signals with poll, and feeds the session as bytes arrive.
#include "live_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <vector>

#include "platform/console.hpp"
#include "platform/network.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

using Seconds = std::chrono::duration<double>;
using TimePoint = LiveClock::time_point;

constexpr std::chrono::seconds between_attempts{1};
/// Time that a client has to read the last frames.
constexpr std::chrono::seconds last_patience{2};

class LiveLoop {
 public:
  explicit LiveLoop(const LivePlan& plan)
      : plan_(plan), session_(*plan.session), output_(*plan.output), buffer_(std::size_t{1} << 16) {
    open_input();
  }

  void run() {
    last_frame_ = LiveClock::now();
    tell_notes();
    while (!ended_) step();
    if (plan_.status != nullptr) plan_.status->stop();
    plan_.came->reset();
    session_.finish();
    tell_notes();
    drain();
  }

 private:
  void open_input() {
    // A program that writes to a pipe can wait for its reader. A device cannot, and its frames
    // would queue up and be late.
    output_.set_dropping(plan_.source != LiveSource::standard);
    switch (plan_.source) {
      case LiveSource::standard:
        return;
      case LiveSource::tcp_listen:
        listener_ = listen_at(plan_.from, Transport::tcp);
        return tell(fmt::format("waiting for a sender at {} (TCP)", place_of(listener_)));
      case LiveSource::udp:
        input_ = listen_at(plan_.from, Transport::udp);
        return tell(fmt::format("waiting for frames at {} (UDP)", place_of(input_)));
      case LiveSource::tcp_connect: {
        std::string error;
        input_ = connect_to(plan_.from, Transport::tcp, error);
        if (!input_) {
          throw Error(ErrorKind::unreadable_input,
                      fmt::format("{}: {}", to_string(plan_.from), error));
        }
        return tell(fmt::format("receiving from {} (TCP)", to_string(plan_.from)));
      }
    }
  }

  void tell(const std::string& text) const {
    if (!plan_.quiet) say(text);
  }
  void tell_notes() {
    for (const std::string& note : session_.take_notes()) tell(note);
  }

  // The events that a step waits for.
  enum Slot : std::size_t { signals, sender, listener, client, slot_count };

  void step() {
    std::array<platform::Awaited, slot_count> waits;
    waits[signals].number = signals_.number();
    waits[sender] = {sender_descriptor(), is_connecting_};
    waits[listener].number = input_ ? -1 : listener_.number();
    waits[client] = {output_.descriptor(), true};
    if (platform::wait_for(waits, timeout_ms()) < 0 && errno != EINTR) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("poll: {}", platform::words_of_error(errno)));
    }
    const auto lock = locked(plan_.status);
    if (waits[signals].is_ready) {
      was_told_ = signals_.take();
      ended_ = true;
      return;
    }
    // A full output stops reading, which does not count as silence of the sender.
    if (waits[sender].number < 0 && plan_.source == LiveSource::standard)
      last_frame_ = LiveClock::now();
    if (waits[client].is_ready) output_.write_some();
    if (waits[sender].is_ready) receive();
    if (waits[listener].is_ready) accept_sender();
    attend_to_time();
    tell_notes();
  }

  int sender_descriptor() const {
    if (plan_.source != LiveSource::standard) return input_.number();
    return output_.is_full() ? -1 : platform::standard_input;
  }

  int timeout_ms() const {
    std::optional<TimePoint> next = output_.next_attempt();
    const auto also = [&next](std::optional<TimePoint> time) {
      if (time && (!next || *time < *next)) next = time;
    };
    also(next_connection_);
    also(stall_time());
    if (!next) return -1;
    const double seconds = Seconds(*next - LiveClock::now()).count();
    return static_cast<int>(std::ceil(1000 * std::clamp(seconds, 0.0, 3600.0)));
  }

  // The time to report a silence or to repeat the last frame.
  std::optional<TimePoint> stall_time() const {
    if (plan_.stall_s <= 0 || session_.counts().frames_in == 0) return std::nullopt;
    if (!is_stalled_) return after(plan_.stall_s);
    if (!plan_.holds) return std::nullopt;
    return after(static_cast<double>(held_ + 1) / session_.frame_rate_hz());
  }
  TimePoint after(double seconds) const {
    return last_frame_ + std::chrono::duration_cast<LiveClock::duration>(Seconds(seconds));
  }

  void attend_to_time() {
    const TimePoint now = LiveClock::now();
    if (output_.next_attempt() && now >= *output_.next_attempt()) output_.try_again();
    if (next_connection_ && now >= *next_connection_) begin_receiving();
    while (stall_time() && now >= *stall_time()) {
      if (!is_stalled_) {
        is_stalled_ = true;
        *plan_.came = now;
        session_.settle();
        tell(fmt::format("no frame for {:.3g} s{}", plan_.stall_s,
                         plan_.holds ? ": repeating the last one" : ""));
      } else {
        *plan_.came = now;
        session_.hold();
        ++held_;
      }
    }
  }

  void accept_sender() {
    input_ = accept_from(listener_);
    if (input_) tell("a sender connected");
  }

  void begin_receiving() {
    next_connection_.reset();
    input_ = begin_connection(plan_.from, Transport::tcp);
    is_connecting_ = static_cast<bool>(input_);
    if (!input_) next_connection_ = LiveClock::now() + between_attempts;
  }

  void receive() {
    if (is_connecting_) {
      is_connecting_ = false;
      if (connection_error(input_) == 0) return tell("the sender is connected again");
      input_.close();
      next_connection_ = LiveClock::now() + between_attempts;
      return;
    }
    const bool standard = plan_.source == LiveSource::standard;
    const int descriptor = standard ? platform::standard_input : input_.number();
    const std::ptrdiff_t count = platform::receive_some(descriptor, buffer_.data(), buffer_.size());
    if (count < 0 && platform::must_wait(errno)) return;
    if (plan_.source == LiveSource::udp) {
      // An error belongs to an earlier datagram; an empty datagram is ignored.
      if (count > 0) feed(static_cast<std::size_t>(count), true);
      return;
    }
    if (count > 0) return feed(static_cast<std::size_t>(count), false);
    if (standard && count < 0) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("standard input: {}", platform::words_of_error(errno)));
    }
    sender_gone(count == 0);
  }

  void feed(std::size_t bytes, bool ends_line) {
    const std::size_t frames_before = session_.counts().frames_in;
    *plan_.came = LiveClock::now();
    session_.feed({buffer_.data(), bytes});
    if (ends_line) session_.end_line();
    if (session_.counts().frames_in == frames_before) return;
    if (is_stalled_) {
      tell(fmt::format("frames arrive again after {:.3g} s",
                       Seconds(**plan_.came - last_frame_).count()));
    }
    is_stalled_ = false;
    held_ = 0;
    last_frame_ = **plan_.came;
  }

  // `whole` means that the sender closed the connection, so its last line is complete.
  void sender_gone(bool whole) {
    if (whole) session_.end_line();
    input_.close();
    ended_ = plan_.source == LiveSource::standard || plan_.once;
    if (ended_) return;
    session_.drop_line();
    tell("the sender disconnected; waiting for it to return");
    if (plan_.source == LiveSource::tcp_connect)
      next_connection_ = LiveClock::now() + between_attempts;
  }

  // Waits for the reader of a pipe, and for a limited time for a client.
  void drain() {
    const TimePoint end = LiveClock::now() + last_patience;
    while (!output_.is_empty()) {
      const double left = Seconds(end - LiveClock::now()).count();
      const bool waits = plan_.source == LiveSource::standard && !was_told_;
      if (output_.descriptor() < 0 || (!waits && left <= 0)) break;
      std::array<platform::Awaited, 2> ends;
      ends[0] = {output_.descriptor(), true};
      ends[1].number = signals_.number();
      const int timeout = waits ? -1 : static_cast<int>(std::ceil(1000 * left));
      if (platform::wait_for(ends, timeout) < 0 && errno != EINTR) break;
      if (ends[0].is_ready) output_.write_some();
      if (ends[1].is_ready) break;
    }
    output_.give_up();
  }

  const LivePlan& plan_;
  LiveSession& session_;
  LiveOutput& output_;
  platform::SignalEnds signals_;
  Descriptor listener_, input_;
  bool is_connecting_ = false;
  std::optional<TimePoint> next_connection_;
  std::vector<char> buffer_;
  TimePoint last_frame_;
  std::size_t held_ = 0;
  bool is_stalled_ = false;
  bool was_told_ = false;
  bool ended_ = false;
};

}  // namespace

void run_live(const LivePlan& plan) { LiveLoop(plan).run(); }

}  // namespace kinemend::cli
