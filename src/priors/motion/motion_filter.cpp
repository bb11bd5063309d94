#include "priors/motion/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "nn/activation_kernel.hpp"

namespace kinemend {

namespace {

constexpr std::size_t steps_filtered_together = 256;

// Of every channel and step: the weights of the levels (C x steps x `motion_levels`), the
// correction and the deviation.
struct Mixes {
  std::vector<float> levels, corrections, deviations;
};

Mixes mixes_of(std::vector<float> outputs, const MotionSteps& steps) {
  const std::size_t count = outputs.size() / motion_outputs;
  Mixes mixes{std::vector<float>(count * motion_levels), std::vector<float>(count),
              std::vector<float>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    float* const own = outputs.data() + i * motion_outputs;
    const float* const scales = steps.scales.data() + i * motion_scales;
    for (std::size_t n = 0; n < motion_scales; ++n)
      mixes.corrections[i] += 0.5F * own[motion_smoothers + n] * scales[n];
    const float most = *std::max_element(own, own + motion_smoothers);
    for (std::size_t n = 0; n < motion_smoothers; ++n) own[n] -= most;
    mixes.deviations[i] = 0.5F * std::clamp(own[motion_outputs - 1], -12.0F, 8.0F);
  }
  nn::exp_of(outputs.data(), outputs.size());
  nn::exp_of(mixes.deviations.data(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* const weights = outputs.data() + i * motion_outputs;
    float* const levels = mixes.levels.data() + i * motion_levels;
    float sum = 0;
    for (std::size_t n = 0; n < motion_smoothers; ++n) sum += weights[n];
    for (std::size_t n = 0; n < bank_levels; ++n) levels[n] = weights[n] / sum;
    levels[bank_levels] = weights[motion_smoothers - 1] / sum;
    for (std::size_t n = bank_levels; n + 1 < motion_smoothers; ++n) {
      const std::size_t level = n - bank_levels + 1;
      levels[level] += 2 * weights[n] / sum;
      levels[level + 1] -= weights[n] / sum;
    }
  }
  return mixes;
}

// Frames [first, last) lie between the first and the last of the steps.
void put_frames(const MotionReader& reader, const MotionSteps& steps, std::vector<float> outputs,
                std::size_t first, std::size_t last, MotionResult& result) {
  const MotionTake& take = reader.take();
  const std::size_t channels = take.channels, count = last - first;
  const Mixes mixes = mixes_of(std::move(outputs), steps);
  std::vector<float> level(count * channels);
  const std::vector<float>& measured = take.measured.empty() ? take.values : take.measured;
  for (std::size_t n = 0; n < motion_levels; ++n) {
    if (n < bank_levels) {
      reader.bank().level(reader.extended(), n, static_cast<std::ptrdiff_t>(first), count, level);
    } else {
      std::copy_n(measured.begin() + static_cast<std::ptrdiff_t>(first * channels), level.size(),
                  level.begin());
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double time = static_cast<double>(first + i) * motion_steps_hz / take.frame_rate_hz;
      const auto before = static_cast<std::size_t>(time);
      const auto share = static_cast<float>(time - static_cast<double>(before));
      const std::size_t s = before - steps.first;
      for (std::size_t c = 0; c < channels; ++c) {
        if (reader.strengths().is_alive[c] == 0) continue;
        const std::size_t one = c * steps.count + s, other = one + 1;
        const auto between = [&](const std::vector<float>& all, std::size_t size, std::size_t k) {
          const float from = all[one * size + k];
          return from + share * (all[other * size + k] - from);
        };
        const std::size_t at = (first + i) * channels + c;
        float& value = result.values[at];
        value = (n == 0 ? 0 : value) +
                between(mixes.levels, motion_levels, n) * level[i * channels + c];
        if (n + 1 < motion_levels) continue;
        value += between(mixes.corrections, 1, 0);
        result.deviation[at] = between(mixes.deviations, 1, 0);
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
