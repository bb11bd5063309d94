// Normalises the weights and scales the corrections of each channel and step.
#include "methods/learned/motion_mixes.hpp"

#include <algorithm>

#include "methods/learned/motion_network.hpp"
#include "nn/activation_kernel.hpp"

namespace kinemend {

void mix(std::span<float> outputs, const MotionSteps& steps, MotionMixes& mixes) {
  const std::size_t count = outputs.size() / motion_outputs;
  mixes.levels.resize(count * motion_levels);
  mixes.corrections.assign(count, 0.0F);
  mixes.deviations.resize(count);
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
}

}  // namespace kinemend
