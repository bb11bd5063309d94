#include "priors/training_sequences.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/convert.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

Clip motion_of(Clip clip) {
  const std::size_t first = leading_calibration_frames(clip);
  return first == 0 ? std::move(clip) : slice(clip, first, clip.frame_count());
}
MarkerClip motion_of(MarkerClip clip) { return clip; }

void report(const TrainSettings& settings, std::string_view stage, std::size_t done,
            std::size_t count) {
  if (settings.progress)
    settings.progress(stage, static_cast<double>(done) / static_cast<double>(count));
}

// How many times the model's rate goes into the take's; 0 where it does not.
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

template <class AnyClip>
BodyChannels channels_at_rate(AnyClip clip, const BodyLayout& layout, double rate_hz,
                              std::size_t& phases) {
  clip = motion_of(std::move(clip));
  phases = whole_ratio(clip.frame_rate_hz, rate_hz);
  if (phases == 0) {
    clip = resample(clip, rate_hz);
    phases = 1;
  }
  return encode_body(clip, layout, match_body(layout, clip));
}

PoseMatrix frames_of(const PoseMatrix& poses, std::size_t first, std::size_t last) {
  PoseMatrix part(last - first, poses.channels);
  std::copy_n(poses.values.begin() + static_cast<std::ptrdiff_t>(first * poses.channels),
              part.values.size(), part.values.begin());
  return part;
}

}  // namespace

BodyLayout learn_layout(const TrainingTakes& takes, const TrainSettings& settings, double trend_s) {
  if (takes.count == 0) throw Error(ErrorKind::usage, "no takes to learn from");
  BodyLayoutBuilder builder(settings.names, trend_s);
  for (std::size_t i = 0; i < takes.count; ++i) {
    report(settings, "looking at bodies", i, takes.count);
    std::visit([&](auto&& clip) { builder.add(motion_of(std::forward<decltype(clip)>(clip))); },
               takes.take(i));
  }
  return builder.finish();
}

double for_each_sequence(const TrainingTakes& takes, const BodyLayout& layout, double rate_hz,
                         std::size_t least_frames, const TrainSettings& settings,
                         const std::function<void(const TrainingSequence&)>& use) {
  double frames = 0;
  for (std::size_t i = 0; i < takes.count; ++i) {
    report(settings, "learning motion", i, takes.count);
    std::size_t phases = 1;
    const BodyChannels channels = std::visit(
        [&](auto&& clip) {
          return channels_at_rate(std::forward<decltype(clip)>(clip), layout, rate_hz, phases);
        },
        takes.take(i));
    for (const Stretch& stretch : whole_stretches(channels)) {
      for (std::size_t phase = 0; phase < phases && stretch.first + phase < stretch.last; ++phase) {
        TrainingSequence sequence{
            thinned(channels.poses, stretch.first + phase, stretch.last, phases),
            1 / static_cast<double>(phases), i};
        if (sequence.poses.frames < std::max<std::size_t>(least_frames, 1)) continue;
        frames += sequence.weight * static_cast<double>(sequence.poses.frames);
        use(sequence);
      }
    }
  }
  return frames / rate_hz;
}

void for_each_half(const TrainingSequence& sequence, std::size_t takes, std::size_t least_frames,
                   const std::function<void(std::size_t half, const PoseMatrix& poses)>& use) {
  const std::size_t middle = sequence.poses.frames / 2;
  if (takes > 1 || middle < least_frames) {
    use(takes > 1 ? sequence.take % 2 : 0, sequence.poses);
    return;
  }
  use(0, frames_of(sequence.poses, 0, middle));
  use(1, frames_of(sequence.poses, middle, sequence.poses.frames));
}

}  // namespace kinemend
