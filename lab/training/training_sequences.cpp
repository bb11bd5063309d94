// Learns the layout of the takes, encodes them, resamples them to one rate, and returns the
// stretches.
#include "lab/training/training_sequences.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "lab/training/take_store.hpp"
#include "lab/training/training_stages.hpp"

namespace kinemend {

namespace {

Take motion_of(Take take) {
  const std::size_t first = take.has_joints() ? leading_calibration_frames(take) : 0;
  return first == 0 ? std::move(take) : slice(take, first, take.frame_count());
}

void report(const TrainSettings& settings, std::string_view stage, std::size_t done,
            std::size_t count) {
  if (settings.progress)
    settings.progress(stage, static_cast<double>(done) / static_cast<double>(count));
}

// The take's rate over the model's if that is a whole number, else 0.
std::size_t whole_ratio(double take_rate_hz, double rate_hz) {
  const double ratio = take_rate_hz / rate_hz;
  const double whole = std::round(ratio);
  return whole >= 1 && std::abs(ratio - whole) < 1e-3 * whole ? static_cast<std::size_t>(whole) : 0;
}

bool is_whole(const BodyChannels& channels, std::size_t frame) {
  const auto row =
      channels.observed.begin() + static_cast<std::ptrdiff_t>(frame * channels.poses.channels);
  return std::all_of(row, row + static_cast<std::ptrdiff_t>(channels.poses.channels),
                     [](std::uint8_t seen) { return seen != 0; });
}

// Every `step`-th frame of [first, last).
PoseMatrix thinned(const PoseMatrix& poses, std::size_t first, std::size_t last, std::size_t step) {
  PoseMatrix result((last - first + step - 1) / step, poses.channels);
  for (std::size_t f = 0; f < result.frames; ++f) {
    const auto from = poses.row(first + f * step);
    std::copy(from.begin(), from.end(), result.row(f).begin());
  }
  return result;
}

struct Stretch {
  std::size_t first, last;  // [first, last)
};

std::vector<Stretch> whole_stretches(const BodyChannels& channels) {
  std::vector<Stretch> stretches;
  for (std::size_t f = 0; f < channels.poses.frames; ++f) {
    if (!is_whole(channels, f)) continue;
    if (stretches.empty() || stretches.back().last != f) stretches.push_back({f, f});
    stretches.back().last = f + 1;
  }
  return stretches;
}

BodyChannels channels_at_rate(Take clip, const BodyLayout& layout, double rate_hz,
                              std::size_t& phases) {
  phases = whole_ratio(clip.frame_rate_hz, rate_hz);
  if (phases == 0) {
    clip = resample(clip, rate_hz);
    phases = 1;
  }
  return encode_body(clip, layout, match_body(layout, clip));
}

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

void add_sequences(const BodyChannels& channels, std::size_t phases, std::size_t take,
                   TrainingStages* stages, TrainingSequences& sequences) {
  for (const Stretch& stretch : whole_stretches(channels)) {
    for (std::size_t phase = 0; phase < phases && stretch.first + phase < stretch.last; ++phase) {
      const PoseMatrix poses = thinned(channels.poses, stretch.first + phase, stretch.last, phases);
      sequences.entries.push_back({poses.frames, 1 / static_cast<double>(phases), take});
      append_values<double>(sequences.values, poses.values);
      if (stages != nullptr) stages->see(bytes_of(poses.values));
    }
  }
}

}  // namespace

TrainingSequences encode_takes(const TrainingTakes& takes, const TrainSettings& settings,
                               double rate_hz, double trend_s) {
  BodyLayoutBuilder builder(settings.names, trend_s);
  // Channels depend on the layout, and the layout on all takes, which are stored in between.
  TakeStore store(settings.most_memory / 2);
  for (std::size_t i = 0; i < takes.count; ++i) {
    report(settings, "reading takes", i, takes.count);
    std::optional<Take> take = takes.take(i);
    if (!take) continue;
    *take = motion_of(std::move(*take));
    builder.add(*take);
    store.add(std::move(*take));
  }
  if (store.count() == 0) throw Error(ErrorKind::usage, "no takes to learn from");
  TrainingSequences sequences;
  sequences.layout = builder.finish();
  sequences.rate_hz = rate_hz;
  sequences.takes = store.count();
  sequences.values = Spool(settings.most_memory / 2);
  for (std::size_t i = 0; i < store.count(); ++i) {
    report(settings, "encoding motion", i, store.count());
    std::size_t phases = 1;
    const BodyChannels channels =
        channels_at_rate(store.take(i), sequences.layout, rate_hz, phases);
    add_sequences(channels, phases, i, settings.stages.get(), sequences);
  }
  if (settings.stages) settings.stages->end_of_takes();
  return sequences;
}

TrainingSequence sequence_at(const TrainingSequences& sequences, std::size_t index,
                             std::size_t first, std::size_t last) {
  const TrainingSequences::Entry& entry = sequences.entries[index];
  last = std::min(last, entry.frames);
  first = std::min(first, last);
  TrainingSequence sequence;
  sequence.weight = entry.weight;
  sequence.take = entry.take;
  sequence.poses.frames = last - first;
  sequence.poses.channels = sequences.layout.channel_count();
  const std::size_t channels = sequence.poses.channels;
  sequence.poses.values =
      read_values<double>(sequences.values, index, first * channels, (last - first) * channels);
  return sequence;
}

double for_each_sequence(const TrainingSequences& sequences, std::size_t least_frames,
                         const TrainSettings& settings,
                         const std::function<void(const TrainingSequence&)>& use) {
  double frames = 0;
  const std::size_t count = sequences.entries.size();
  for (std::size_t i = 0; i < count; ++i) {
    report(settings, "learning motion", i, count);
    const TrainingSequences::Entry& entry = sequences.entries[i];
    if (entry.frames < std::max<std::size_t>(least_frames, 1)) continue;
    frames += entry.weight * static_cast<double>(entry.frames);
    use(sequence_at(sequences, i));
  }
  return frames / sequences.rate_hz;
}

void for_each_half(const TrainingSequence& sequence, std::size_t takes, std::size_t least_frames,
                   const std::function<void(std::size_t half, const PoseMatrix& poses)>& use) {
  const std::size_t middle = sequence.poses.frames / 2;
  if (takes > 1 || middle < least_frames) {
    use(takes > 1 ? sequence.take % 2 : 0, sequence.poses);
    return;
  }
  use(0, thinned(sequence.poses, 0, middle, 1));
  use(1, thinned(sequence.poses, middle, sequence.poses.frames, 1));
}

ChannelMoments channel_moments(const TrainingSequences& sequences, std::size_t lag) {
  const std::size_t channels = sequences.layout.channel_count();
  std::vector<double> sum(channels), square(channels), change(channels);
  double frames = 0, changes = 0;
  for (std::size_t i = 0; i < sequences.entries.size(); ++i) {
    const TrainingSequence sequence = sequence_at(sequences, i);
    for (std::size_t f = 0; f < sequence.poses.frames; ++f) {
      frames += sequence.weight;
      const bool has_next = f + lag < sequence.poses.frames;
      changes += has_next ? sequence.weight : 0;
      for (std::size_t c = 0; c < channels; ++c) {
        const double value = sequence.poses(f, c);
        sum[c] += sequence.weight * value;
        square[c] += sequence.weight * value * value;
        if (!has_next) continue;
        const double step = sequence.poses(f + lag, c) - value;
        change[c] += sequence.weight * step * step;
      }
    }
  }
  ChannelMoments result;
  for (std::size_t c = 0; c < channels; ++c) {
    const double mean = sum[c] / frames;
    result.mean.push_back(mean);
    result.deviation.push_back(std::sqrt(std::max(0.0, square[c] / frames - mean * mean)));
    result.change.push_back(std::sqrt(change[c] / std::max(changes, 1.0)));
  }
  return result;
}

}  // namespace kinemend
