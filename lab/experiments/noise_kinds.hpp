// Noise of joints with a shaped spectrum, which the program's damages do not offer.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/signal.hpp"
#include "kinemend/take.hpp"
#include "motion/rotation.hpp"

namespace kinemend::papers {

/// Adds noise with a deviation of `std_deg` per axis, shaped from white noise by `shape` (F x 3 J).
inline Take with_shaped_noise(Take clip, double std_deg, std::uint64_t seed,
                              const std::function<void(PoseMatrix&)>& shape) {
  PoseMatrix noise(clip.frame_count(), 3 * clip.joint_count());
  Random random(seed);
  for (double& value : noise.values) value = random.normal();
  shape(noise);
  double square = 0;
  for (const double value : noise.values) square += value * value;
  const double unit =
      radians_per_degree * std_deg / std::sqrt(square / static_cast<double>(noise.values.size()));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      clip.rotation(f, j) = clip.rotation(f, j) * exp(unit * vector_at(noise, f, j));
    }
  }
  return clip;
}

/// Noise after a low-pass filter, as in many capture pipelines.
inline Take low_passed_noise(const Take& clip, std::uint64_t seed) {
  return with_shaped_noise(clip, 3, seed, [&](PoseMatrix& noise) {
    filter_zero_phase(noise, butterworth_lowpass(2, 4, clip.frame_rate_hz));
  });
}

/// Noise of a 30 Hz system whose poses were interpolated to the rate of the take.
inline Take noise_of_30_hz(const Take& clip, std::uint64_t seed) {
  return with_shaped_noise(clip, 1.5, seed, [&](PoseMatrix& noise) {
    const auto step = static_cast<std::size_t>(std::lround(clip.frame_rate_hz / 30));
    for (std::size_t f = 0; f < noise.frames; ++f) {
      const std::size_t before = f - f % step, after = std::min(before + step, noise.frames - 1);
      const double share = static_cast<double>(f - before) / static_cast<double>(step);
      if (f == before || after % step != 0) continue;
      for (std::size_t c = 0; c < noise.channels; ++c)
        noise(f, c) = noise(before, c) + share * (noise(after, c) - noise(before, c));
    }
  });
}

}  // namespace kinemend::papers
