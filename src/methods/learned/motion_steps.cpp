// Reads steps of a whole take from its bank of smoothers.
#include "methods/learned/motion_steps.hpp"

#include <algorithm>
#include <cmath>

#include "methods/learned/motion_bands.hpp"

namespace kinemend {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t steps_read_together = 512;  // limits memory

}  // namespace

std::size_t frames_of_quick_noise(double frame_rate_hz) {
  return static_cast<std::size_t>(std::ceil(0.04 * frame_rate_hz));
}

std::size_t motion_step_count(std::size_t frames, double frame_rate_hz) {
  return static_cast<std::size_t>(
             static_cast<double>(frames - 1) * motion_steps_hz / frame_rate_hz + 1e-9) +
         2;
}

std::size_t frame_of_motion_step(std::size_t step, double frame_rate_hz) {
  return static_cast<std::size_t>(
      std::lround(static_cast<double>(step) * frame_rate_hz / motion_steps_hz));
}

std::size_t MotionTake::frame_of_step(std::size_t step) const {
  return std::min(frames - 1, frame_of_motion_step(step, frame_rate_hz));
}

MotionReader::MotionReader(const MotionTake& take)
    : take_(take),
      bank_(take.frame_rate_hz),
      extended_(bank_.extended(take.values, take.channels)) {
  const std::size_t channels = take.channels, steps = take.steps();
  const BandHats hats(take.frame_rate_hz);
  StrengthSums sums(channels);
  BandBlock block;
  std::vector<float> slowest(channels);
  for (std::size_t first = 0; first < steps; first += steps_read_together) {
    const std::vector<std::ptrdiff_t> frames =
        frames_of(first, std::min(steps_read_together, steps - first));
    read_bands(bank_, extended_, hats, frames, block);
    for (std::size_t s = 0; s < frames.size(); ++s) {
      for (std::size_t c = 0; c < channels; ++c)
        slowest[c] = block.level_at(bank_levels - 1, frames[s], c) - take.values[c];
      const std::size_t size = channels * motion_bands;
      sums.add(std::span(block.squares).subspan(s * size, size), slowest, 1);
    }
  }
  sums.strengths(take.is_position, take.expects_slow_noise, strengths_);
}

std::vector<std::ptrdiff_t> MotionReader::frames_of(std::size_t first, std::size_t count) const {
  std::vector<std::ptrdiff_t> frames;
  for (std::size_t s = first; s < first + count; ++s)
    frames.push_back(static_cast<std::ptrdiff_t>(take_.frame_of_step(s)));
  return frames;
}

// Mean square that the smoothing by the measured noise removes about a step, for all channels.
void MotionReader::read_taken_out(std::size_t frame, const std::vector<float>& weights,
                                  std::vector<float>& result) const {
  std::fill(result.begin(), result.end(), 0.0F);
  if (take_.measured.empty()) return;
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  const auto at = static_cast<std::ptrdiff_t>(frame),
             last = static_cast<std::ptrdiff_t>(take_.frames) - 1;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const auto row =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + k, 0, last)) * take_.channels;
    const float weight = weights[static_cast<std::size_t>(std::abs(k))];
    for (std::size_t c = 0; c < take_.channels; ++c) {
      const float difference = take_.values[row + c] - take_.measured[row + c];
      result[c] += weight * difference * difference;
    }
  }
}

float MotionReader::missing_share(std::size_t frame, std::size_t channel) const {
  if (take_.missing.empty()) return 0;
  const auto half =
      static_cast<std::ptrdiff_t>(std::lround(take_.frame_rate_hz / motion_steps_hz / 2));
  float missing = 0, seen = 0;
  for (std::ptrdiff_t k = -half; k <= half; ++k) {
    const std::ptrdiff_t f = static_cast<std::ptrdiff_t>(frame) + k;
    if (f < 0 || f >= static_cast<std::ptrdiff_t>(take_.frames)) continue;
    (take_.is_missing(static_cast<std::size_t>(f), channel) ? missing : seen) += 1;
  }
  return missing > 0 ? missing / (missing + seen) : 0;
}

MotionSteps MotionReader::steps(std::size_t first, std::size_t count) const {
  const std::size_t channels = take_.channels;
  const BandHats hats(take_.frame_rate_hz);
  const std::vector<std::ptrdiff_t> frames = frames_of(first, count);
  BandBlock block;
  read_bands(bank_, extended_, hats, frames, block);
  MotionSteps result;
  result.first = first;
  result.resize(channels, count);
  result.take_features = strengths_.features;
  const auto speed = static_cast<float>(take_.frame_rate_hz / motion_change_rate_hz);
  const std::vector<float>& measured = take_.measured.empty() ? take_.values : take_.measured;
  std::vector<float> taken_out(channels);
  for (std::size_t s = 0; s < count; ++s) {
    const auto frame = static_cast<std::size_t>(frames[s]);
    const std::size_t next = std::min(frame + 1, take_.frames - 1);
    read_taken_out(frame, hats.quick, taken_out);
    for (std::size_t c = 0; c < channels; ++c) {
      MeasuredAt at{measured[frame * channels + c], 0, taken_out[c], !take_.measured.empty()};
      at.change = speed * (measured[next * channels + c] - at.level);
      write_step(block, s, frames[s], c, take_.frame_rate_hz, strengths_, missing_share(frame, c),
                 at, step_row(result, c, s));
    }
  }
  return result;
}

void MotionSteps::resize(std::size_t channels, std::size_t steps) {
  count = steps;
  features.resize(channels * count * motion_features);
  levels.resize(channels * count * motion_levels);
  changes.resize(levels.size());
  scales.resize(channels * count * motion_scales);
}

}  // namespace kinemend
