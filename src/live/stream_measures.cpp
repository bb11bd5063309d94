// Follows the sender's clock slowly, so that network jitter is not taken for losses.
#include "live/stream_measures.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinemend {

namespace {

// A frame that is later than this share of a frame has missing frames before it.
constexpr double late_share = 0.75;
// The share of a frame's lateness that the clock follows: a tenth suppresses most jitter. All of
// these are chosen by hand, not swept.
constexpr double following = 0.1;
// The time over which the rate is measured.
constexpr double window_s = 2;
// The relative difference between measured and expected rate from which a message is written.
constexpr double other_rate = 0.1;
constexpr std::size_t most_notes = 5;

}  // namespace

std::size_t FrameClock::frames_before(double now_s) {
  const double period_s = 1 / frame_rate_hz_;
  double late_s = now_s - expected_s_;
  if (!runs_ || late_s > longest_gap_s_ || late_s < -period_s) {
    if (!runs_ || late_s > 0) window_frames_ = 0;
    runs_ = true;
    late_s = 0;
    expected_s_ = now_s;
  }
  measure(now_s);
  const auto missing =
      late_s < late_share * period_s
          ? std::size_t{0}
          : static_cast<std::size_t>(std::floor(late_s / period_s + (1 - late_share)));
  late_s -= static_cast<double>(missing) * period_s;
  expected_s_ += static_cast<double>(missing + 1) * period_s + following * late_s;
  return missing;
}

void FrameClock::measure(double now_s) {
  if (window_frames_++ == 0) window_begin_s_ = now_s;
  if (now_s - window_begin_s_ < window_s) return;
  measured_hz_ = static_cast<double>(window_frames_ - 1) / (now_s - window_begin_s_);
  window_begin_s_ = now_s;
  window_frames_ = 1;
}

std::string FrameClock::take_note(std::size_t latency_frames) {
  const double reference_hz = told_hz_ > 0 ? told_hz_ : frame_rate_hz_;
  if (measured_hz_ == 0 || notes_ == most_notes ||
      std::fabs(measured_hz_ - reference_hz) <= other_rate * reference_hz)
    return {};
  told_hz_ = measured_hz_;
  ++notes_;
  return fmt::format("{:.3g} frames per second arrive, and {:.6g} are expected (--fps): {}",
                     measured_hz_, frame_rate_hz_,
                     measured_hz_ < frame_rate_hz_
                         ? std::string("missing ones are interpolated")
                         : fmt::format("the delay is {:.3g} ms",
                                       1000 * static_cast<double>(latency_frames) / measured_hz_));
}

}  // namespace kinemend
