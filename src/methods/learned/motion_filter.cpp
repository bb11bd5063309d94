// Runs the network on blocks of steps and mixes the smoothed levels for each frame. Smooths
// channels by their measured noise and combines both estimates for each track.
#include "methods/learned/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "methods/auto/track_cleaning.hpp"
#include "methods/auto/vector_tracks.hpp"
#include "methods/learned/motion_network.hpp"
#include "nn/kernels.hpp"

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

namespace {

// Smooths tracks of one kind together, as `auto` does.
void smooth_together(const std::vector<std::size_t>& numbers, TrackKind kind, MotionTake& take) {
  const std::size_t count = numbers.size();
  if (count == 0) return;
  VectorTracks tracks(take.frames, count, [&](std::size_t f, std::size_t n) {
    const float* const v = take.values.data() + f * take.channels + 3 * numbers[n];
    return Vec3{v[0], v[1], v[2]};
  });
  const SampleMarks no_suspects(take.frames, count);
  const SampleMarks gaps(take.frames, count, [&](std::size_t f, std::size_t n) {
    return take.is_missing(f, 3 * numbers[n]);
  });
  const CleanedTracks verdicts =
      clean_tracks(tracks, no_suspects, gaps, std::vector<std::vector<std::size_t>>(count),
                   take.frame_rate_hz, {1, false, kind, {}});
  for (std::size_t n = 0; n < count; ++n) {
    if (verdicts.shares[n] == 0) continue;
    for (std::size_t f = 0; f < take.frames; ++f) {
      const Vec3 v = tracks.at(f, n);
      float* const to = take.measured.data() + f * take.channels + 3 * numbers[n];
      to[0] = static_cast<float>(v.x);
      to[1] = static_cast<float>(v.y);
      to[2] = static_cast<float>(v.z);
    }
  }
}

// Sums over the observed samples: squares of what an estimate removes, and of the quick part.
struct TakenOut {
  double all = 0, quick = 0;
};

TakenOut taken_out(const MotionTake& take, const std::vector<float>& estimate, std::size_t track) {
  const std::size_t later = frames_of_quick_noise(take.frame_rate_hz);
  TakenOut sums;
  const auto change = [&](std::size_t i) {
    return static_cast<double>(estimate[i] - take.values[i]);
  };
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      if (take.is_missing(f, c)) continue;
      const std::size_t i = f * take.channels + c;
      sums.all += change(i) * change(i);
      if (f < later || take.is_missing(f - later, c)) continue;
      const double difference = change(i) - change(i - later * take.channels);
      sums.quick += 0.5 * difference * difference;
    }
  }
  return sums;
}

}  // namespace

void join_measured(const MotionTake& take, MotionResult& result) {
  if (take.measured.empty()) return;
  for (std::size_t track = 0; track < take.channels / 3; ++track) {
    const TakenOut by_measure = taken_out(take, take.measured, track);
    if (by_measure.all == 0) continue;
    const double by_network = taken_out(take, result.values, track).all;
    const double quick = std::min(1.0, by_measure.quick / by_measure.all);
    const auto share =
        static_cast<float>(quick * quick * by_measure.all / (by_measure.all + by_network));
    for (std::size_t f = 0; f < take.frames; ++f) {
      for (std::size_t i = f * take.channels + 3 * track; i < f * take.channels + 3 * track + 3;
           ++i)
        result.values[i] += share * (take.measured[i] - result.values[i]);
    }
  }
}

void add_measured_smoothing(MotionTake& take) {
  take.measured = take.values;
  if (take.frames < fewest_clean_frames) return;
  std::vector<std::size_t> turning, moving;
  for (std::size_t n = 0; n < take.channels / 3; ++n)
    (take.is_position[3 * n] != 0 ? moving : turning).push_back(n);
  smooth_together(turning, TrackKind::rotations, take);
  smooth_together(moving, TrackKind::positions, take);
}

}  // namespace kinemend
