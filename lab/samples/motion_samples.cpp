// Draws a stretch and varies and damages it, or takes a pair of recordings.
#include "lab/samples/motion_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"
#include "lab/samples/motion_noise.hpp"
#include "lab/samples/sequence_damage.hpp"
#include "lab/samples/warped_sequence.hpp"
#include "methods/learned/motion_channels.hpp"
#include "methods/learned/motion_filter.hpp"

namespace kinemend {

namespace {

// A stretch that is being damaged.
struct DamagedStretch {
  const BodyLayout& layout;
  double rate_hz;
  PoseMatrix poses;
  std::vector<std::uint8_t> observed;  // F x tracks; empty: all

  void apply(std::string_view name, const OptionValues& values, Random& random) {
    Random own = random.fork(random.next());
    damage_sequence(layout, rate_hz, poses, observed, name, values, own);
  }

  bool add_noise(bool has_slow, Random& random) {
    return add_random_noise(poses, rate_hz, random_strengths(poses, 0.55, random), has_slow,
                            random);
  }

  void lower_rate(Random& random) {
    const double lower = rate_hz / static_cast<double>(2 + random.below(4));
    apply(random.chance(0.4) ? "held" : "upsampled", {{"rate_hz", lower}}, random);
  }

  void lose_samples(Random& random) {
    if (random.chance(0.2))
      apply("outliers",
            {{"share", log_uniform(random, 0.001, 0.02)}, {"std_deg", random.uniform(5, 30)}},
            random);
    if (random.chance(0.15)) open_gaps(random);
  }

  void open_gaps(Random& random) {
    apply("gaps",
          {{"start_probability", log_uniform(random, 0.001, 0.01)},
           {"mean_length_s", log_uniform(random, 0.02, 1.5)},
           {"scope", std::string("joint")}},
          random);
  }

  SampleDamage damage(const MotionSampling& sampling, std::span<const MotionPair> pairs,
                      Random& random) {
    bool is_slow = false;
    const double kind = random.uniform();
    if (sampling.has_slow_noise && !pairs.empty() && random.chance(sampling.residual_share)) {
      add_residuals(poses, rate_hz, pairs, random);
      is_slow = true;
    } else if (kind < 0.88) {
      is_slow = add_noise(sampling.has_slow_noise, random);
    } else {
      is_slow = true;
      static constexpr std::array<const char*, 5> systems{"video", "triangulated", "depth",
                                                          "inertial", "optical"};
      apply("system",
            {{"kind", std::string(systems[random.below(systems.size())])},
             {"strength", log_uniform(random, 0.3, 2)}},
            random);
    }
    lose_samples(random);
    bridge_lost(poses, observed);
    if (rate_hz >= 100 && random.chance(0.15)) lower_rate(random);
    if (sampling.has_slow_noise && low_pass_at_random(poses, rate_hz, 0.3, random)) is_slow = true;
    return is_slow ? SampleDamage::slow : SampleDamage::quick;
  }
};

// Calibrates joint frames as the method does, by the mean pose of the stretch or by one near it,
// like that of a longer take.
PoseMatrix calibrated_at_random(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                                Random& random) {
  BodyCalibration calibration = calibration_of(poses, layout);
  if (random.chance(0.5)) {
    const double size_rad = log_uniform(random, 0.03, 0.3);
    for (Quat& turn : calibration.turns)
      turn = turn * exp({size_rad * random.normal(), size_rad * random.normal(),
                         size_rad * random.normal()});
  }
  return calibrated(poses, rate_hz, layout, calibration);
}

void turn_axes(PoseMatrix& poses, Random& random) {
  for (std::size_t track = 0; track < poses.channels / 3; ++track) turn_track(poses, track, random);
}

template <class Value>
void reverse_rows(std::vector<Value>& values, std::size_t channels) {
  const std::size_t frames = channels > 0 ? values.size() / channels : 0;
  for (std::size_t f = 0; f < frames / 2; ++f)
    std::swap_ranges(values.begin() + static_cast<std::ptrdiff_t>(f * channels),
                     values.begin() + static_cast<std::ptrdiff_t>((f + 1) * channels),
                     values.begin() + static_cast<std::ptrdiff_t>((frames - 1 - f) * channels));
}

PoseMatrix random_stretch(const TrainingSequences& sequences, double pace, std::size_t frames,
                          Random& random) {
  const auto wanted = static_cast<std::size_t>(pace * static_cast<double>(frames)) + 3;
  std::vector<double> shares;
  for (const TrainingSequences::Entry& entry : sequences.entries) {
    const bool fits = 2 * entry.frames >= wanted;
    shares.push_back(fits ? entry.weight * std::sqrt(static_cast<double>(entry.frames)) : 0);
  }
  const std::size_t index = drawn_index(shares, random);
  const std::size_t have = sequences.entries[index].frames, taken = std::min(wanted, have);
  const std::size_t first = random.below(have - taken + 1);
  // A stretch that is too short is played more slowly.
  const double slower = std::min(1.0, static_cast<double>(have) / static_cast<double>(wanted));
  return warped(sequence_at(sequences, index, first, first + taken).poses, pace * slower, frames);
}

MotionSample random_damage(const MotionSources& sources, const MotionSampling& sampling,
                           bool is_live, Random random) {
  const TrainingSequences& sequences = sources.sequences;
  const double rate_hz = random_rate_hz(random);
  const double pace = random_pace(random) * sequences.rate_hz / rate_hz;
  PoseMatrix poses = random_stretch(sequences, pace, sample_frames(sampling, rate_hz), random);
  const std::size_t channels = poses.channels;
  // A stream is not calibrated: its mean pose is not known yet.
  if (!is_live) poses = calibrated_at_random(poses, rate_hz, sequences.layout, random);
  const MotionForm form{random.chance(0.5), random.chance(0.5)};
  const std::vector<float> shown =
      in_form(std::vector<float>(poses.values.begin(), poses.values.end()), form, sources.mirror);
  poses.values.assign(shown.begin(), shown.end());
  vary_motion(poses, rate_hz, {}, random);
  const bool is_known = random.chance(0.7);
  if (!is_known && random.chance(0.7)) turn_axes(poses, random);

  MotionSample sample;
  sample.truth.assign(poses.values.begin(), poses.values.end());
  DamagedStretch damaged{sequences.layout, rate_hz, std::move(poses), {}};
  SampleDamage damage = SampleDamage::none;
  if (!random.chance(sampling.clean_share)) {
    damage = damaged.damage(sampling, sources.pairs, random);
  } else if (random.chance(0.4)) {
    // Clean takes have gaps, too.
    damaged.open_gaps(random);
    bridge_lost(damaged.poses, damaged.observed);
  }
  MotionTake& take = sample.take;
  take.frames = damaged.poses.frames;
  take.channels = channels;
  take.frame_rate_hz = rate_hz;
  take.expects_slow_noise = is_said_to_be_slow(damage, random);
  take.values.assign(damaged.poses.values.begin(), damaged.poses.values.end());
  if (!damaged.observed.empty()) {
    take.missing.resize(take.values.size());
    for (std::size_t i = 0; i < take.missing.size(); ++i)
      take.missing[i] =
          damaged.observed[i / channels * (channels / 3) + i % channels / 3] == 0 ? 1 : 0;
  }
  for (std::size_t c = 0; c < channels; ++c) {
    take.is_position.push_back(c / 3 >= sequences.layout.track_count() ? 1 : 0);
    take.slots.push_back(is_known ? static_cast<std::int32_t>(c) : -1);
  }
  if (is_known && random.chance(0.2)) {
    for (std::size_t c = 0; c < channels; c += 3) {
      if (random.chance(0.2))
        std::fill_n(take.slots.begin() + static_cast<std::ptrdiff_t>(c), 3, -1);
    }
  }
  if (random.chance(is_known ? 0.2 : 0.7))
    lose_whole_tracks(sample, is_known ? random.uniform(0.02, 0.5) : random.uniform(0.1, 0.9),
                      random);
  return sample;
}

// Draws a pair in proportion to its length.
const MotionPair& drawn_pair(std::span<const MotionPair> pairs, Random& random) {
  std::vector<double> seconds;
  for (const MotionPair& pair : pairs) {
    const MotionTake& take = pair.sample.take;
    seconds.push_back(static_cast<double>(take.frames) / take.frame_rate_hz);
  }
  return pairs[drawn_index(seconds, random)];
}

// A stretch of a pair, its channels mirrored and scaled at random. In a share of samples the input
// is the reference: a clean take, low-passed like optical ones.
MotionSample random_pair(const MotionPair& pair, std::size_t channels,
                         const MotionSampling& sampling, Random random) {
  const MotionTake& whole = pair.sample.take;
  const std::size_t frames = std::min(sample_frames(sampling, whole.frame_rate_hz), whole.frames);
  const std::size_t first = random.below(whole.frames - frames + 1);
  const bool is_clean = random.chance(sampling.clean_share);
  MotionSample sample;
  MotionTake& take = sample.take;
  take.frames = frames;
  take.channels = channels;
  take.frame_rate_hz = whole.frame_rate_hz;
  take.expects_slow_noise =
      is_said_to_be_slow(is_clean ? SampleDamage::none : SampleDamage::slow, random);
  take.values.assign(frames * channels, 0.0F);
  take.slots.assign(channels, -1);
  take.is_position.assign(channels, 0);
  sample.truth = take.values;
  const std::vector<float>& seen = is_clean ? pair.sample.truth : whole.values;
  const bool has_gaps = !is_clean && !whole.missing.empty();
  if (has_gaps) take.missing.assign(take.values.size(), 0);
  const auto scale = static_cast<float>(portable::exp(0.2 * random.normal()));
  const std::size_t shown = std::min(whole.channels, channels);
  for (std::size_t c = 0; c < shown; ++c) {
    const float factor = random.chance(0.5) ? scale : -scale;
    take.is_position[c] = whole.is_position[c];
    for (std::size_t f = 0; f < frames; ++f) {
      const std::size_t from = (first + f) * whole.channels + c, to = f * channels + c;
      take.values[to] = factor * seen[from];
      sample.truth[to] = factor * pair.sample.truth[from];
      if (has_gaps) take.missing[to] = whole.missing[from];
    }
  }
  if (random.chance(0.5)) {
    reverse_rows(take.values, channels);
    reverse_rows(take.missing, channels);
    reverse_rows(sample.truth, channels);
  }
  return sample;
}

}  // namespace

MotionStatistics motion_statistics(const TrainingSequences& sequences) {
  // Degrees, and degrees in 1/120 s: channels that hardly move are not amplified. Chosen by hand,
  // not swept.
  constexpr double least_deviation = 1, least_speed_deg = 0.02;
  const ChannelMoments moments = channel_moments(sequences, 1);
  MotionStatistics result;
  for (std::size_t c = 0; c < moments.mean.size(); ++c) {
    const double speed = moments.change[c] * sequences.rate_hz / 120;
    result.mean.push_back(static_cast<float>(moments.mean[c]));
    result.deviation.push_back(static_cast<float>(std::max(least_deviation, moments.deviation[c])));
    result.speed.push_back(static_cast<float>(std::max(least_speed_deg, speed)));
  }
  return result;
}

MotionPair mapped_pair(MotionPair pair, double least_deg) {
  MotionSample& sample = pair.sample;
  const std::size_t channels = sample.take.channels, frames = sample.take.frames;
  const auto n = static_cast<double>(frames);
  for (std::size_t c = 0; c < channels; ++c) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      const double truth = sample.truth[f * channels + c],
                   seen = sample.take.values[f * channels + c];
      x += truth, y += seen, xx += truth * truth, xy += truth * seen;
    }
    const double spread = xx / n - x * x / (n * n);
    if (std::sqrt(std::max(0.0, spread)) < least_deg) {
      stand_still(sample, c);
      continue;
    }
    const double gain = (xy / n - x * y / (n * n)) / spread, offset = (y - gain * x) / n;
    for (std::size_t f = 0; f < frames; ++f) {
      float& truth = sample.truth[f * channels + c];
      truth = static_cast<float>(gain * static_cast<double>(truth) + offset);
    }
  }
  return pair;
}

MotionSample random_motion_sample(const MotionSources& sources, const MotionSampling& sampling,
                                  Random random) {
  const std::size_t channels = sources.sequences.layout.channel_count();
  const bool is_pair = !sources.pairs.empty() && random.chance(sampling.pair_share);
  const bool is_live = random.chance(sampling.live_share);
  const bool is_of_markers =
      !is_pair && !sources.markers.empty() && random.chance(sampling.marker_share);
  const bool is_of_rig =
      !is_pair && !is_of_markers && !sources.rigs.empty() && random.chance(sampling.rig_share);
  const Random own = random.fork(1);
  MotionSample sample =
      is_pair         ? random_pair(drawn_pair(sources.pairs, random), channels, sampling, own)
      : is_of_markers ? random_marker_sample(sources.markers, channels, sampling, own)
      : is_of_rig     ? random_rig_sample(sources, channels, sampling, own)
                      : random_damage(sources, sampling, is_live, own);
  sample.is_live = is_live;
  if (!is_live) add_measured_smoothing(sample.take);
  return sample;
}

}  // namespace kinemend
