// Takes frames in, runs the network at each step, and mixes the due frames.
#include "methods/learned/live_motion_filter.hpp"

#include <algorithm>
#include <utility>

namespace kinemend {

LiveMotionFilter::LiveMotionFilter(const MotionNetwork& network, double frame_rate_hz,
                                   const std::vector<std::int32_t>& slots,
                                   std::vector<std::uint8_t> is_position, bool expects_slow_noise)
    : frame_rate_hz_(frame_rate_hz),
      steps_(frame_rate_hz, std::move(is_position), expects_slow_noise),
      network_(network, slots),
      levels_(bank_levels * slots.size()) {}

bool LiveMotionFilter::push(std::span<const float> values, std::span<const std::uint8_t> missing,
                            std::span<float> out) {
  steps_.push(values, missing);
  while (take_step()) continue;
  if (steps_.frames() <= given_ + ahead()) return false;
  give(out);
  return true;
}

bool LiveMotionFilter::flush(std::span<float> out) {
  steps_.end();
  if (given_ >= steps_.frames()) return false;
  const std::size_t wanted = step_before(given_) + 1;
  while (known_ <= wanted && take_step()) continue;
  give(out);
  return true;
}

std::size_t LiveMotionFilter::step_before(std::size_t frame) const {
  return static_cast<std::size_t>(static_cast<double>(frame) * motion_steps_hz / frame_rate_hz_);
}

bool LiveMotionFilter::take_step() {
  if (!steps_.next_step(step_)) return false;
  MotionMixes& mixes = mixes_[known_++ % mixes_.size()];
  mix(network_.run(step_, steps_.is_alive()), step_, mixes);
  // Channels that have not moved are unchanged.
  for (std::size_t c = 0; c < steps_.channels(); ++c) {
    if (steps_.is_alive()[c] != 0) continue;
    float* const levels = mixes.levels.data() + c * motion_levels;
    std::fill_n(levels, motion_levels, 0.0F);
    levels[0] = 1;
    mixes.corrections[c] = 0;
  }
  return true;
}

void LiveMotionFilter::give(std::span<float> out) {
  const std::size_t frame = given_++, channels = steps_.channels(), before = step_before(frame);
  const auto share = static_cast<float>(
      static_cast<double>(frame) * motion_steps_hz / frame_rate_hz_ - static_cast<double>(before));
  const MotionMixes &one = mixes_[before % mixes_.size()],
                    &other = mixes_[(before + 1) % mixes_.size()];
  const auto between = [&](const std::vector<float>& from, const std::vector<float>& to,
                           std::size_t i) { return from[i] + share * (to[i] - from[i]); };
  steps_.levels(frame, levels_);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t at = c * motion_levels;
    // Without measured noise the last smoother is the sample itself.
    float value = between(one.corrections, other.corrections, c) +
                  between(one.levels, other.levels, at + bank_levels) * levels_[c];
    for (std::size_t n = 0; n < bank_levels; ++n)
      value += between(one.levels, other.levels, at + n) * levels_[n * channels + c];
    out[c] = value;
  }
}

}  // namespace kinemend
