#include "priors/recurrent_samples.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "priors/auto_channels.hpp"
#include "priors/sequence_damage.hpp"
#include "priors/warped_sequence.hpp"

namespace kinemend {

namespace {

constexpr double clean_share = 0.2;
constexpr double least_speed = 0.75, most_speed = 1.35;
constexpr double least_sample_noise_deg = 0.15, most_sample_noise_deg = 6;

std::vector<float> to_floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

// A take that is being damaged.
struct Damaged {
  const BodyLayout& layout;
  double rate_hz;
  PoseMatrix poses;
  std::vector<std::uint8_t> observed;  // F x tracks

  void apply(std::string_view name, const OptionValues& values, Random& random) {
    Random own = random.fork(random.next());
    damage_sequence(layout, rate_hz, poses, observed, name, values, own);
  }
};

void add_noise(Damaged& take, Random& random) {
  const double std_deg = log_uniform(random, least_sample_noise_deg, most_sample_noise_deg);
  const double kind = random.uniform();
  if (kind < 0.3) {
    take.apply("gaussian", {{"std_deg", std_deg}, {"root", random.chance(0.5)}}, random);
  } else if (kind < 0.6) {
    take.apply("gaussian-channels", {{"k", log_uniform(random, 0.08, 1)}}, random);
  } else if (kind < 0.65) {
    take.apply("uniform", {{"half_width_deg", 1.7 * std_deg}}, random);
  } else if (kind < 0.8) {
    take.apply("ar1", {{"std_deg", std_deg}, {"correlation", random.uniform(0.2, 0.97)}}, random);
  } else if (kind < 0.9) {
    take.apply("gaussian", {{"std_deg", std_deg}}, random);
    const bool holds = random.chance(0.5);
    const double step = 2 + static_cast<double>(random.below(3));
    take.apply(holds ? "held" : "upsampled", {{"rate_hz", take.rate_hz / step}}, random);
  } else {
    static const std::vector<std::string> kinds{"video", "triangulated", "depth", "inertial",
                                                "optical"};
    take.apply(
        "system",
        {{"kind", kinds[random.below(kinds.size())]}, {"strength", log_uniform(random, 0.3, 2)}},
        random);
  }
}

void add_events(Damaged& take, Random& random) {
  if (random.chance(0.25))
    take.apply("outliers",
               {{"share", log_uniform(random, 0.001, 0.02)}, {"std_deg", random.uniform(5, 30)}},
               random);
  if (random.chance(0.12))
    take.apply("gaps",
               {{"start_probability", log_uniform(random, 0.001, 0.03)},
                {"mean_length_s", log_uniform(random, 0.02, 0.3)},
                {"scope", std::string("joint")}},
               random);
}

// Some joints are not in the take at all.
void lose_tracks(Damaged& take, Random& random) {
  if (!random.chance(0.15)) return;
  const std::size_t tracks = take.poses.channels / 3;
  if (take.observed.empty()) take.observed.assign(take.poses.frames * tracks, 1);
  const double share = random.uniform(0.02, 0.3);
  for (std::size_t n = 0; n < tracks; ++n) {
    if (!random.chance(share)) continue;
    for (std::size_t f = 0; f < take.poses.frames; ++f) take.observed[f * tracks + n] = 0;
  }
}

}  // namespace

RecurrentSample in_form(const RecurrentSample& sample, RecurrentForm form,
                        const BodyMirror& mirror) {
  return {in_form(sample.take, form, mirror), in_form(sample.truth, form, mirror)};
}

RecurrentSample of_another_body(RecurrentSample sample, double offset_deg, double most_scale,
                                Random random) {
  const double most = std::log(most_scale);
  const auto scale = static_cast<float>(std::exp(random.uniform(-most, most)));
  std::vector<float> offsets;
  for (std::size_t c = 0; c < sample.take.channels; ++c)
    offsets.push_back(static_cast<float>(offset_deg * random.normal()));
  for (std::vector<float>* values :
       {&sample.take.measured, &sample.take.automatic, &sample.truth}) {
    for (std::size_t i = 0; i < values->size(); ++i)
      (*values)[i] = scale * (*values)[i] + offsets[i % offsets.size()];
  }
  return sample;
}

RecurrentSample recurrent_sample(const BodyLayout& layout, double rate_hz, const PoseMatrix& truth,
                                 Random random) {
  Damaged take{layout, rate_hz, truth, {}};
  if (!random.chance(clean_share)) {
    add_noise(take, random);
    add_events(take, random);
  }
  lose_tracks(take, random);
  return recurrent_sample_of(layout, rate_hz, truth, take.poses, take.observed);
}

RecurrentSample recurrent_sample_of(const BodyLayout& layout, double rate_hz,
                                    const PoseMatrix& truth, const PoseMatrix& poses,
                                    const std::vector<std::uint8_t>& observed) {
  PoseMatrix bridged = poses;
  bridge_lost(bridged, observed);
  const AutoChannels automatic = auto_of_channels(layout, rate_hz, bridged, observed);
  RecurrentSample sample;
  const std::size_t channels = truth.channels, tracks = channels / 3;
  sample.take.frames = truth.frames;
  sample.take.channels = channels;
  sample.take.measured = to_floats(bridged.values);
  sample.take.automatic = to_floats(automatic.poses.values);
  sample.truth = to_floats(truth.values);
  sample.take.marks.resize(truth.frames * tracks);
  for (std::size_t f = 0; f < truth.frames; ++f) {
    for (std::size_t n = 0; n < tracks; ++n) {
      const bool lost = !observed.empty() && observed[f * tracks + n] == 0;
      const bool spike = automatic.suspect[f * channels + 3 * n] != 0;
      sample.take.marks[f * tracks + n] = lost || spike ? 1 : 0;
    }
  }
  return sample;
}

RecurrentSample random_recurrent_sample(const TrainingSequences& sequences, std::size_t frames,
                                        Random random) {
  std::vector<double> ends;
  for (const TrainingSequences::Entry& entry : sequences.entries) {
    const bool fits = static_cast<double>(entry.frames) > 0.25 * static_cast<double>(frames);
    const double share = fits ? entry.weight * static_cast<double>(entry.frames) : 0;
    ends.push_back(share + (ends.empty() ? 0 : ends.back()));
  }
  const double at = random.uniform() * ends.back();
  const auto index =
      static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin());
  const std::size_t have = sequences.entries[index].frames;
  const double speed = random.uniform(least_speed, most_speed);
  const auto wanted = static_cast<std::size_t>(speed * static_cast<double>(frames)) + 2;
  const std::size_t taken = std::min(wanted, have);
  const std::size_t first = random.below(have - taken + 1);
  const PoseMatrix poses = sequence_at(sequences, index, first, first + taken).poses;
  const auto made = static_cast<std::size_t>(static_cast<double>(taken - 1) / speed);
  return recurrent_sample(sequences.layout, sequences.rate_hz,
                          warped(poses, speed, std::min(made, frames)), random.fork(1));
}

RecurrentStatistics recurrent_statistics(const TrainingSequences& sequences) {
  constexpr double least_deviation = 0.5, least_speed_deg = 0.05;
  const ChannelMoments moments = channel_moments(sequences, recurrent_step);
  RecurrentStatistics result;
  for (std::size_t c = 0; c < moments.mean.size(); ++c) {
    result.mean.push_back(static_cast<float>(moments.mean[c]));
    result.deviation.push_back(static_cast<float>(std::max(least_deviation, moments.deviation[c])));
    result.speed.push_back(static_cast<float>(std::max(least_speed_deg, moments.change[c])));
  }
  return result;
}

}  // namespace kinemend
