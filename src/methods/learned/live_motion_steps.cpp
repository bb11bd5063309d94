// Keeps the last frames, bridges gaps, extends the end, and reads one step after the other.
#include "methods/learned/live_motion_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinemend {

namespace {

// Lookahead of the live form: 14 frames at 120 Hz, and at most that up to 390 Hz; see
// docs/methods/learned.md.
constexpr double ahead_s = 0.117;
constexpr std::size_t most_ahead = 14;
// The number of steps in the training samples.
constexpr std::size_t strength_steps = 128;

std::size_t frames_to_next_step(double frame_rate_hz) {
  return static_cast<std::size_t>(std::lround(frame_rate_hz / motion_steps_hz));
}

}  // namespace

std::size_t live_motion_ahead(double frame_rate_hz) {
  const auto wanted = static_cast<std::size_t>(std::lround(ahead_s * frame_rate_hz));
  // Mixing a frame needs the steps before and after it.
  return std::max(std::min(wanted, most_ahead), frames_to_next_step(frame_rate_hz) + 1);
}

LiveMotionSteps::LiveMotionSteps(double frame_rate_hz, std::vector<std::uint8_t> is_position,
                                 bool expects_slow_noise)
    : frame_rate_hz_(frame_rate_hz),
      is_position_(std::move(is_position)),
      expects_slow_noise_(expects_slow_noise),
      bank_(frame_rate_hz),
      hats_(frame_rate_hz),
      ahead_(live_motion_ahead(frame_rate_hz)),
      step_ahead_(ahead_ - std::min(ahead_, frames_to_next_step(frame_rate_hz))),
      missed_(channels()),
      origins_(channels()),
      kept_squares_(strength_steps * channels() * motion_bands),
      kept_slowest_(strength_steps * channels()),
      sums_(channels()) {
  const auto margin = static_cast<std::size_t>(hats_.margin());
  past_ = bank_.reach() + margin + ahead_ + 1;
  behind_ = bank_.reach() + margin + 1;
  rows_.channels = channels();
  rows_.values.resize((3 * past_ + behind_) * channels());
  missing_.resize(3 * past_ * channels());
  strengths_.is_alive.resize(channels());
}

void LiveMotionSteps::push(std::span<const float> values, std::span<const std::uint8_t> missing) {
  if (frames_ == 0) {
    for (std::size_t c = 0; c < channels(); ++c) {
      origins_[c] = missing.empty() || missing[c] == 0 ? values[c] : 0;
      for (std::size_t row = 0; row < past_; ++row)
        rows_.values[row * channels() + c] = origins_[c];
    }
    std::fill_n(missing_.begin(), past_ * channels(), std::uint8_t{0});
  }
  make_room();
  const std::size_t row = row_index(frames_);
  ++frames_;
  float* const own = rows_.values.data() + row * channels();
  std::uint8_t* const marks = missing_.data() + row * channels();
  for (std::size_t c = 0; c < channels(); ++c) {
    marks[c] = missing.empty() ? 0 : missing[c];
    if (marks[c] != 0) {
      own[c] = *(own + c - channels());
      ++missed_[c];
      continue;
    }
    own[c] = values[c];
    if (missed_[c] > 0 && missed_[c] + 1 == frames_) {
      begin_with(values[c], c);
    } else if (missed_[c] > 0) {
      bridge(c);
    }
    missed_[c] = 0;
  }
}

// Moves the rows that are still needed to the front.
void LiveMotionSteps::make_room() {
  if (row_index(frames_) < 3 * past_) return;
  const std::size_t kept = past_, from = row_index(frames_) - kept;
  const auto at = [&](std::size_t row) { return static_cast<std::ptrdiff_t>(row * channels()); };
  std::copy(rows_.values.begin() + at(from), rows_.values.begin() + at(from + kept),
            rows_.values.begin());
  std::copy(missing_.begin() + at(from), missing_.begin() + at(from + kept), missing_.begin());
  dropped_ += from;
}

// A channel that is first seen is taken to have stood still before.
void LiveMotionSteps::begin_with(float value, std::size_t channel) {
  for (std::size_t row = 0; row < row_index(frames_); ++row)
    rows_.values[row * channels() + channel] = value;
  origins_[channel] = value;
}

// The newest frame has ended a gap: frames of the gap that are not yet out are interpolated
// linearly.
void LiveMotionSteps::bridge(std::size_t channel) {
  const std::size_t open = std::min(missed_[channel], ahead_);
  float* const last = row_of(frames_ - 1) + channel;
  const auto width = static_cast<std::ptrdiff_t>(channels());
  const float from = *(last - static_cast<std::ptrdiff_t>(open + 1) * width);
  for (std::size_t i = 1; i <= open; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(open + 1);
    *(last - static_cast<std::ptrdiff_t>(open + 1 - i) * width) = from + share * (*last - from);
  }
}

void LiveMotionSteps::extend() {
  if (extended_at_ == frames_) return;
  extended_at_ = frames_;
  bank_.extend(row_of(frames_ - 1), static_cast<std::ptrdiff_t>(channels()), channels(), past_,
               behind_);
}

std::span<const float> LiveMotionSteps::frame(std::size_t frame) const {
  return std::span(rows_.values).subspan(row_index(frame) * channels(), channels());
}

void LiveMotionSteps::levels(std::size_t frame, std::span<float> result) {
  extend();
  for (std::size_t level = 0; level < bank_levels; ++level)
    bank_.level(rows_, level, static_cast<std::ptrdiff_t>(row_index(frame)), 1,
                result.subspan(level * channels(), channels()));
}

float LiveMotionSteps::missing_share(std::size_t frame, std::size_t channel) const {
  const std::size_t half = frames_to_next_step(frame_rate_hz_ / 2);
  const std::size_t at = row_index(frame), last = std::min(at + half, row_index(frames_ - 1));
  float missing = 0;
  for (std::size_t row = at - half; row <= last; ++row)
    missing += missing_[row * channels() + channel] != 0 ? 1.0F : 0.0F;
  return missing / static_cast<float>(last + 1 - (at - half));
}

void LiveMotionSteps::keep_strengths(std::ptrdiff_t row) {
  const std::size_t squares = channels() * motion_bands, place = steps_ % strength_steps;
  const std::span<float> own = std::span(kept_squares_).subspan(place * squares, squares),
                         slowest = std::span(kept_slowest_).subspan(place * channels(), channels());
  if (steps_ >= strength_steps) sums_.add(own, slowest, -1);
  std::copy(block_.squares.begin(), block_.squares.end(), own.begin());
  for (std::size_t c = 0; c < channels(); ++c)
    slowest[c] = block_.level_at(bank_levels - 1, row, c) - origins_[c];
  sums_.add(own, slowest, 1);
  sums_.strengths(is_position_, expects_slow_noise_, strengths_);
}

bool LiveMotionSteps::next_step(MotionSteps& step) {
  if (frames_ == 0) return false;
  const std::size_t wanted = frame_of_motion_step(steps_, frame_rate_hz_);
  if (!is_ended_ && wanted + step_ahead_ >= frames_) return false;
  const std::size_t frame = std::min(wanted, frames_ - 1);
  if (is_ended_ && steps_ >= motion_step_count(frames_, frame_rate_hz_)) return false;
  extend();
  const auto row = static_cast<std::ptrdiff_t>(row_index(frame));
  read_bands(bank_, rows_, hats_, {&row, 1}, block_);
  keep_strengths(row);
  step.first = steps_++;
  step.resize(channels(), 1);
  step.take_features = strengths_.features;
  for (std::size_t c = 0; c < channels(); ++c) {
    const StepRow own = step_row(step, c, 0);
    write_step(block_, 0, row, c, frame_rate_hz_, strengths_, missing_share(frame, c),
               {block_.level_at(0, row, c), 0, 0, false}, own);
    own.changes[bank_levels] = own.changes[0];
  }
  return true;
}

}  // namespace kinemend
