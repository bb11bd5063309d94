// Waits for datagrams, signals and silence, keeps a session for each sender, and sends the
// sessions' output.
#include "live_vmc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/network.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

using Seconds = std::chrono::duration<double>;

// Sender addresses can be forged, so an unlimited number would fill the memory.
constexpr std::size_t most_senders = 16;
// After this silence, another sender may take the place.
constexpr double forgotten_s = 10;
// Number of datagrams received before signals and time are checked again.
constexpr int most_in_a_row = 64;
constexpr std::size_t most_datagram_bytes = std::size_t{1} << 16;

struct VmcSender {
  std::unique_ptr<VmcSession> session;
  double last_s = 0;
};

VmcCounts operator+(VmcCounts a, const VmcCounts& b) {
  a.datagrams_in += b.datagrams_in;
  a.datagrams_out += b.datagrams_out;
  a.frames += b.frames;
  a.poses += b.poses;
  a.cleaned += b.cleaned;
  a.missing += b.missing;
  a.made_up += b.made_up;
  a.not_finite += b.not_finite;
  a.not_osc += b.not_osc;
  a.other_bones += b.other_bones;
  a.settled += b.settled;
  return a;
}

Json json_of_counts(const VmcCounts& c) {
  return {{"datagrams_in", c.datagrams_in},
          {"datagrams_out", c.datagrams_out},
          {"frames", c.frames},
          {"poses", c.poses},
          {"cleaned", c.cleaned},
          {"missing", c.missing},
          {"interpolated", c.made_up},
          {"not_finite", c.not_finite},
          {"not_osc", c.not_osc},
          {"other_bones", c.other_bones},
          {"pauses", c.settled}};
}

class VmcLoop {
 public:
  explicit VmcLoop(const VmcPlan& plan) : plan_(plan), buffer_(most_datagram_bytes) {
    // A method that cannot run live is refused before any socket is opened.
    const auto session = made_session();
    latency_frames_ = session->latency_frames();
    input_ = listen_at(plan.from, Transport::udp);
    std::string error;
    output_ = connect_to(plan.to, Transport::udp, error);
    if (!output_)
      throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", to_string(plan.to), error));
    tell(fmt::format("method {}", plan.cleaner->name()));
    tell(fmt::format("{} frames of delay, {:.3g} ms at {:.6g} Hz", latency_frames_, delay_ms(),
                     plan.options.frame_rate_hz));
    tell(fmt::format("waiting for VMC at {} (UDP), sending to {}", place_of(input_),
                     to_string(plan.to)));
  }

  void run() {
    if (plan_.status != nullptr) plan_.status->start([this] { return report(); });
    last_frame_s_ = now_s();
    while (!ended_) step();
    if (plan_.status != nullptr) plan_.status->stop();
    for (auto& [name, sender] : senders_) sender.session->settle();
    tell_notes();
    tell_summary();
  }

 private:
  std::unique_ptr<VmcSession> made_session() {
    return std::make_unique<VmcSession>(*plan_.cleaner, plan_.options,
                                        [this](std::string_view datagram) { send(datagram); });
  }

  static double now_s() { return Seconds(LiveClock::now().time_since_epoch()).count(); }
  double delay_ms() const {
    return 1000 * static_cast<double>(latency_frames_) / plan_.options.frame_rate_hz;
  }
  void tell(const std::string& text) const {
    if (!plan_.quiet) say(text);
  }

  void step() {
    std::array<platform::Awaited, 2> waits;
    waits[0].number = signals_.number();
    waits[1].number = input_.number();
    if (platform::wait_for(waits, timeout_ms()) < 0 && errno != EINTR) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("poll: {}", platform::words_of_error(errno)));
    }
    const auto lock = locked(plan_.status);
    if (waits[0].is_ready) {
      signals_.take();
      ended_ = true;
      return;
    }
    if (waits[1].is_ready) receive();
    attend_to_time();
    tell_notes();
  }

  int timeout_ms() const {
    double due_s =
        plan_.stall_s > 0 && !is_stalled_ && had_frame_ ? last_frame_s_ + plan_.stall_s : HUGE_VAL;
    for (const auto& [name, sender] : senders_) due_s = std::min(due_s, sender.session->due_s());
    if (due_s == HUGE_VAL) return -1;
    return static_cast<int>(std::ceil(1000 * std::clamp(due_s - now_s(), 0.0, 3600.0)));
  }

  void receive() {
    std::string name;
    for (int i = 0; i < most_in_a_row; ++i) {
      const std::ptrdiff_t count = receive_datagram(input_, buffer_, name);
      // An error belongs to an earlier datagram.
      if (count < 0) return;
      take({buffer_.data(), static_cast<std::size_t>(count)}, name);
    }
  }

  void take(std::string_view datagram, const std::string& name) {
    came_s_ = now_s();
    VmcSender* const sender = sender_of(name);
    if (sender == nullptr) {
      ++passed_;
      return send(datagram);
    }
    sender->last_s = came_s_;
    const std::size_t frames = sender->session->counts().frames;
    sender->session->receive(datagram, came_s_);
    if (sender->session->counts().frames != frames) note_frame();
  }

  // Returns null if there are too many senders.
  VmcSender* sender_of(const std::string& name) {
    const auto found = senders_.find(name);
    if (found != senders_.end()) return &found->second;
    if (senders_.size() == most_senders && !forget_a_sender()) {
      if (passed_ == 0)
        tell(fmt::format("there are {} senders: what others send passes unchanged", most_senders));
      return nullptr;
    }
    tell(fmt::format("a sender at {}", name));
    return &senders_.emplace(name, VmcSender{made_session(), came_s_}).first->second;
  }

  bool forget_a_sender() {
    const auto oldest = std::min_element(
        senders_.begin(), senders_.end(),
        [](const auto& a, const auto& b) { return a.second.last_s < b.second.last_s; });
    if (came_s_ - oldest->second.last_s < forgotten_s) return false;
    oldest->second.session->settle();
    gone_ = gone_ + oldest->second.session->counts();
    senders_.erase(oldest);
    return true;
  }

  void note_frame() {
    if (is_stalled_)
      tell(fmt::format("frames arrive again after {:.3g} s", came_s_ - last_frame_s_));
    is_stalled_ = false;
    had_frame_ = true;
    last_frame_s_ = came_s_;
  }

  void attend_to_time() {
    const double time_s = now_s();
    for (auto& [name, sender] : senders_) {
      if (time_s < sender.session->due_s()) continue;
      came_s_ = time_s;
      sender.session->attend(time_s);
    }
    if (plan_.stall_s <= 0 || is_stalled_ || !had_frame_ || time_s < last_frame_s_ + plan_.stall_s)
      return;
    is_stalled_ = true;
    tell(fmt::format("no frame for {:.3g} s", plan_.stall_s));
  }

  // If the receiver refused an earlier datagram, the error appears at the next one, which is not
  // sent then; so it is sent again.
  void send(std::string_view datagram) {
    for (int attempt = 0; attempt < 2; ++attempt) {
      if (platform::send_some(output_.number(), datagram) >= 0) {
        latency_.add(now_s() - came_s_);
        return;
      }
      if (platform::must_wait(errno)) break;
    }
    ++not_sent_;
  }

  void tell_notes() {
    for (auto& [name, sender] : senders_) {
      for (const std::string& note : sender.session->take_notes())
        tell(senders_.size() == 1 ? note : fmt::format("{}: {}", name, note));
    }
  }

  void tell_summary() const {
    VmcCounts c = gone_;
    for (const auto& [name, sender] : senders_) c = c + sender.session->counts();
    tell(fmt::format("datagrams: {} in, {} out, {} not OSC, {} not sent", c.datagrams_in + passed_,
                     c.datagrams_out + passed_, c.not_osc, not_sent_));
    tell(
        fmt::format("frames: {}, {} interpolated; bones: {}, {} changed, {} missing, {} not finite",
                    c.frames, c.made_up, c.poses, c.cleaned, c.missing, c.not_finite));
    if (latency_.empty()) return;
    tell(latency_text(latency_, delay_ms()));
  }

  Json report() const {
    Json all = Json::array();
    for (const auto& [name, sender] : senders_) {
      all.push_back({{"from", name},
                     {"frame_rate_hz", sender.session->measured_hz()},
                     {"unit", "degrees"},
                     {"counts", json_of_counts(sender.session->counts())},
                     {"tracks", json_of(sender.session->changes())}});
    }
    return status_report(plan_.cleaner->name(), {latency_frames_, delay_ms()}, latency_,
                         std::move(all));
  }

  const VmcPlan& plan_;
  platform::SignalEnds signals_;
  Descriptor input_, output_;
  std::vector<char> buffer_;
  std::size_t latency_frames_ = 0;
  std::map<std::string, VmcSender> senders_;  ///< by address and port
  VmcCounts gone_;                            ///< sums over forgotten senders
  std::size_t passed_ = 0;                    ///< datagrams of further senders, passed unchanged
  std::size_t not_sent_ = 0;
  LatencyHistogram latency_;
  double came_s_ = 0;  ///< arrival time of the datagram in progress
  double last_frame_s_ = 0;
  bool had_frame_ = false, is_stalled_ = false, ended_ = false;
};

}  // namespace

void run_vmc(const VmcPlan& plan) { VmcLoop(plan).run(); }

}  // namespace kinemend::cli
