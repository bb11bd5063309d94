// Fills and clears channels, loses samples and whole tracks, and finds the length of a sample.
#include "lab/samples/motion_samples.hpp"

#include <algorithm>
#include <cmath>

#include "lab/samples/sequence_damage.hpp"

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

std::vector<std::uint8_t> lose_samples_at_random(PoseMatrix& values, double rate_hz,
                                                 Random& random) {
  const std::size_t count = values.channels / 3;
  std::vector<std::uint8_t> observed(values.frames * count, 1);
  const double start = log_uniform(random, 0.001, 0.01), mean_s = log_uniform(random, 0.02, 1.5);
  const double end = std::min(1.0, 1 / (mean_s * rate_hz));
  for (std::size_t n = 0; n < count; ++n) {
    bool is_lost = false;
    for (std::size_t f = 0; f < values.frames; ++f) {
      is_lost = random.chance(is_lost ? 1 - end : start);
      if (is_lost) observed[f * count + n] = 0;
    }
  }
  bridge_lost(values, observed);
  return observed;
}

void put_values(MotionSample& sample, const PoseMatrix& seen, const PoseMatrix& truth,
                std::span<const double> origin, const std::vector<std::uint8_t>& observed,
                std::size_t channels) {
  MotionTake& take = sample.take;
  take.frames = seen.frames;
  take.channels = channels;
  take.values.assign(seen.frames * channels, 0.0F);
  sample.truth = take.values;
  const std::size_t shown = std::min(channels, seen.channels), tracks = seen.channels / 3;
  if (!observed.empty()) take.missing.assign(take.values.size(), 0);
  for (std::size_t f = 0; f < seen.frames; ++f) {
    for (std::size_t c = 0; c < shown; ++c) {
      const std::size_t to = f * channels + c;
      take.values[to] = static_cast<float>(seen(f, c) - origin[c]);
      sample.truth[to] = static_cast<float>(truth(f, c) - origin[c]);
      if (!observed.empty()) take.missing[to] = observed[f * tracks + c / 3] == 0 ? 1 : 0;
    }
  }
}

std::size_t sample_frames(const MotionSampling& sampling, double rate_hz) {
  return static_cast<std::size_t>(
             std::lround(static_cast<double>(sampling.steps - 1) * rate_hz / motion_steps_hz)) +
         1;
}

}  // namespace kinemend
