// Reads blocks of steps, runs the network on them, and mixes the smoothed levels for each frame.
#include "methods/learned/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "methods/learned/motion_mixes.hpp"

namespace kinemend {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t steps_filtered_together = 256;  // limits memory

// Writes frames [first, last), which lie between the first and the last of the steps.
void put_frames(const MotionReader& reader, const MotionSteps& steps, std::vector<float> outputs,
                std::size_t first, std::size_t last, MotionResult& result) {
  const MotionTake& take = reader.take();
  const std::size_t channels = take.channels, count = last - first;
  MotionMixes mixes;
  mix(outputs, steps, mixes);
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
    put_frames(reader, part, run(network, {take.slots, reader.strengths().is_alive}, part),
               frame_at(first), end, result);
  });
  return result;
}

}  // namespace kinemend
