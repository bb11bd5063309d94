// Empties channels, loses whole tracks, and finds the length of a sample.
#include "learned/corrector/motion_samples.hpp"

#include <cmath>

namespace kinemend {

void stand_still(MotionSample& sample, std::size_t channel) {
  for (std::size_t f = 0; f < sample.take.frames; ++f) {
    const std::size_t at = f * sample.take.channels + channel;
    sample.take.values[at] = sample.truth[at] = 0;
    if (!sample.take.missing.empty()) sample.take.missing[at] = 0;
  }
}

void lose_whole_tracks(MotionSample& sample, double share, Random& random) {
  const std::size_t tracks = sample.take.channels / 3, kept = random.below(tracks);
  for (std::size_t n = 0; n < tracks; ++n) {
    if (n == kept || !random.chance(share)) continue;
    for (std::size_t c = 3 * n; c < 3 * n + 3; ++c) stand_still(sample, c);
  }
}

std::size_t sample_frames(const MotionSampling& sampling, double rate_hz) {
  return static_cast<std::size_t>(
             std::lround(static_cast<double>(sampling.steps - 1) * rate_hz / motion_steps_hz)) +
         1;
}

}  // namespace kinemend
