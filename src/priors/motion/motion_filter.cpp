#include "priors/motion/motion_filter.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace kinemend {

namespace {

constexpr std::size_t steps_filtered_together = 256;

// Weights of the levels, the correction and the logarithm of the variance of a channel at a step.
struct StepMix {
  float levels[bank_levels] = {};
  float correction = 0, log_variance = 0;
};

StepMix mix_of(const float* outputs, const float* scales) {
  StepMix mix;
  float weights[motion_smoothers], sum = 0;
  const float most = *std::max_element(outputs, outputs + motion_smoothers);
  for (std::size_t i = 0; i < motion_smoothers; ++i) {
    weights[i] = std::exp(outputs[i] - most);
    sum += weights[i];
  }
  for (std::size_t level = 0; level < bank_levels; ++level)
    mix.levels[level] = weights[level] / sum;
  for (std::size_t i = bank_levels; i < motion_smoothers; ++i) {
    const std::size_t level = i - bank_levels + 1;
    mix.levels[level] += 2 * weights[i] / sum;
    mix.levels[level + 1] -= weights[i] / sum;
  }
  for (std::size_t i = 0; i < motion_scales; ++i)
    mix.correction += 0.5F * outputs[motion_smoothers + i] * scales[i];
  mix.log_variance = std::clamp(outputs[motion_outputs - 1], -12.0F, 8.0F);
  return mix;
}

// Frames [first, last) lie between the first and the last of the steps.
void put_frames(const MotionReader& reader, const MotionSteps& steps,
                const std::vector<float>& outputs, std::size_t first, std::size_t last,
                MotionResult& result) {
  const MotionTake& take = reader.take();
  const std::size_t channels = take.channels, count = last - first;
  std::vector<StepMix> mixes(channels * steps.count);
  for (std::size_t i = 0; i < mixes.size(); ++i)
    mixes[i] = mix_of(outputs.data() + i * motion_outputs, steps.scales.data() + i * motion_scales);
  std::vector<float> level(count * channels);
  for (std::size_t n = 0; n < bank_levels; ++n) {
    reader.bank().level(reader.extended(), n, static_cast<std::ptrdiff_t>(first), count, level);
    for (std::size_t i = 0; i < count; ++i) {
      const double time = static_cast<double>(first + i) * motion_steps_hz / take.frame_rate_hz;
      const auto before = static_cast<std::size_t>(time);
      const auto share = static_cast<float>(time - static_cast<double>(before));
      const std::size_t s = before - steps.first;
      for (std::size_t c = 0; c < channels; ++c) {
        if (reader.strengths().is_alive[c] == 0) continue;
        const StepMix *one = &mixes[c * steps.count + s], *other = one + 1;
        const std::size_t at = (first + i) * channels + c;
        const float weight = one->levels[n] + share * (other->levels[n] - one->levels[n]);
        float& value = result.values[at];
        value = (n == 0 ? 0 : value) + weight * level[i * channels + c];
        if (n + 1 < bank_levels) continue;
        value += one->correction + share * (other->correction - one->correction);
        result.deviation[at] = std::exp(
            0.5F * (one->log_variance + share * (other->log_variance - one->log_variance)));
      }
    }
  }
}

}  // namespace

MotionResult filtered(const MotionNetwork& network, const MotionTake& take) {
  MotionResult result{take.values, std::vector<float>(take.values.size(), 0.0F)};
  if (take.frames < 2) return result;
  const MotionReader reader(take);
  const std::size_t steps = take.steps(), reach = network.reach();
  const std::size_t blocks = (steps - 1 + steps_filtered_together - 1) / steps_filtered_together;
  for_each_parallel(blocks, take.values.size(), [&](std::size_t b) {
    const std::size_t first = b * steps_filtered_together;
    const std::size_t last = std::min(first + steps_filtered_together, steps - 1);
    const std::size_t from = first - std::min(first, reach);
    const std::size_t to = std::min(steps, last + 1 + reach);
    const MotionSteps part = reader.steps(from, to - from);
    const auto frame_at = [&](std::size_t step) {
      const double frame = static_cast<double>(step) * take.frame_rate_hz / motion_steps_hz;
      return std::min(take.frames, static_cast<std::size_t>(std::ceil(frame - 1e-9)));
    };
    const std::size_t end = last + 1 == steps ? take.frames : frame_at(last);
    put_frames(reader, part, run(network, reader, part), frame_at(first), end, result);
  });
  return result;
}

}  // namespace kinemend
