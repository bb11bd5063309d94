// The method `auto` cleans the rotations and the positions of a take, each by its measured noise.
#include "methods/auto/auto.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "cleaner/method_row.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/methods.hpp"
#include "methods/auto/track_cleaning.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

namespace {

const OptionTable<AutoOptions>& auto_table() {
  static const auto options =
      OptionTable<AutoOptions>()
          .number(&AutoOptions::sensitivity, "sensitivity", "", 0, 4,
                  "factor on the estimated noise: above 1 smooths more, below 1 less, 0 not at all")
          .flag(&AutoOptions::despike, "despike", "find and repair spikes");
  return options;
}

// The median noise of the smoothed tracks; none if no track is to be smoothed.
std::optional<NoiseCharacter> character_of(const TakeView& take, Space space,
                                           const CleanedTracks& verdicts) {
  std::vector<double> strengths;
  for (std::size_t n = 0; n < verdicts.noise.size(); ++n) {
    if (verdicts.shares[n] > 0) strengths.push_back(verdicts.noise[n]);
  }
  if (strengths.empty()) return std::nullopt;
  const double unit = 1 / degrees_per_unit(take, space);
  return NoiseCharacter{space, unit * median_of(strengths),
                        verdicts.spectrum.is_clear ? verdicts.spectrum.correlation : 0,
                        verdicts.pattern.step, verdicts.pattern.join == SampleJoin::linear};
}

TrackKind kind_of(const Track& track) {
  return track.space == Space::rotation ? TrackKind::rotations : TrackKind::positions;
}

struct JudgedTracks {
  VectorTracks tracks;  // after `clean_tracks`
  CleanedTracks verdicts;
};

// Tracks of one space, and the verdicts of `clean_tracks` on them.
JudgedTracks judge_tracks(const TakeView& take, const std::vector<std::size_t>& numbers,
                          const TrackCleaningSettings& settings, ShareProgress* progress) {
  if (progress != nullptr) progress->begin_part(0.2, numbers.size());
  TracksRead read = read_tracks(take, numbers, false, progress);
  CleanedTracks verdicts =
      clean_tracks(read.vectors, read.suspects, read.gaps, tracks_nearby(take, numbers),
                   take.frame_rate_hz, settings, progress);
  return {std::move(read.vectors), std::move(verdicts)};
}

// The tracks that may change, by space.
struct TracksBySpace {
  std::vector<std::size_t> rotations, positions;
};
TracksBySpace tracks_by_space(const TakeView& take) {
  TracksBySpace found;
  for (const std::size_t track : changeable_tracks(take)) {
    (take.tracks[track].space == Space::rotation ? found.rotations : found.positions)
        .push_back(track);
  }
  return found;
}

class Auto final : public OptionedCleaner<AutoOptions> {
 public:
  using OptionedCleaner::OptionedCleaner;

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& tell) const override {
    CleanTrace trace;
    const auto [rotations, positions] = tracks_by_space(take);
    if (take.frames < fewest_clean_frames) {
      keep_bridges(take, rotations, sink);
      return trace;
    }
    trace.noise.assign(take.tracks.size(), 0);
    // Keyframes are not measured, so none of their motion is noise.
    if (take.source == Source::keyframed) {
      keep_bridges(take, rotations, sink);
      return trace;
    }
    ShareProgress progress(tell);
    clean_together(take, rotations, sink, progress, trace);
    clean_together(take, positions, sink, progress, trace);
    return trace;
  }

 private:
  // Cleans rotations and positions separately: their noise is independent.
  void clean_together(const TakeView& take, const std::vector<std::size_t>& numbers,
                      const TrackSink& sink, ShareProgress& progress, CleanTrace& trace) const {
    const std::size_t frames = take.frames, count = numbers.size();
    if (count == 0) return;
    const JudgedTracks judged = judge_tracks(take, numbers, settings_for(take, numbers), &progress);
    const VectorTracks& tracks = judged.tracks;
    const CleanedTracks& verdicts = judged.verdicts;
    if (const auto character = character_of(take, take.tracks[numbers.front()].space, verdicts))
      trace.characters.push_back(*character);
    progress.begin_part(1, count);
    for_each_parallel(count, frames * count, [&](std::size_t n) {
      const Track& track = take.tracks[numbers[n]];
      trace.noise[numbers[n]] = verdicts.noise[n] / degrees_per_unit(take, track.space);
      const auto spikes = verdicts.marked.track(n);
      const bool smoothed = verdicts.shares[n] != 0;
      const bool spiked = std::find(spikes.begin(), spikes.end(), 1) != spikes.end();
      if (smoothed || spiked || needs_bridges(take, numbers[n])) {
        CleanedTrack cleaned = track_of(take, numbers[n], tracks.track(n), spikes, smoothed);
        if (smoothed && verdicts.spectrum.is_clear)
          cleaned.noise = {trace.noise[numbers[n]], verdicts.spectrum.correlation};
        sink(numbers[n], std::move(cleaned));
      }
      progress.step();
    });
  }

  TrackCleaningSettings settings_for(const TakeView& take,
                                     const std::vector<std::size_t>& numbers) const {
    TrackCleaningSettings settings{.sensitivity = options_.sensitivity,
                                   .despike = options_.despike,
                                   .kind = kind_of(take.tracks[numbers.front()])};
    settings.correlation = take.noise_correlation;
    for (const std::size_t n : numbers) {
      const Track& track = take.tracks[n];
      settings.noise.push_back(degrees_per_unit(take, track.space) * track.noise);
    }
    return settings;
  }

  static bool needs_bridges(const TakeView& take, std::size_t number) {
    return take.gaps == GapTreatment::bridge && !observed_of(take.tracks[number]).empty();
  }

  static void keep_bridges(const TakeView& take, const std::vector<std::size_t>& rotations,
                           const TrackSink& sink) {
    for (const std::size_t track : rotations) sink(track, assemble(rotation_piece(take, track)));
  }
};

}  // namespace

MeasuredNoise measure_noise(const TakeView& take) {
  MeasuredNoise measured;
  const std::size_t count = take.tracks.size();
  if (take.frames < fewest_clean_frames) return measured;
  measured.noise.assign(count, 0);
  measured.coloured.resize(count);
  measured.spikes.resize(count);
  // Keyframes are not measured, so none of their motion is noise.
  if (take.source == Source::keyframed) return measured;
  const auto [rotations, positions] = tracks_by_space(take);
  for (const std::vector<std::size_t>& numbers : {rotations, positions}) {
    if (numbers.empty()) continue;
    const CleanedTracks verdicts =
        judge_tracks(take, numbers,
                     {.kind = kind_of(take.tracks[numbers.front()]), .smooth = false}, nullptr)
            .verdicts;
    if (const auto character = character_of(take, take.tracks[numbers.front()].space, verdicts))
      measured.characters.push_back(*character);
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      const std::size_t track = numbers[n];
      measured.noise[track] = verdicts.noise[n] / degrees_per_unit(take, take.tracks[track].space);
      if (verdicts.spectrum.is_clear && verdicts.shares[n] != 0)
        measured.coloured[track] = {measured.noise[track], verdicts.spectrum.correlation};
      const auto spikes = verdicts.marked.track(n);
      if (std::find(spikes.begin(), spikes.end(), 1) != spikes.end())
        measured.spikes[track].assign(spikes.begin(), spikes.end());
    }
  }
  return measured;
}

std::unique_ptr<Cleaner> make_auto(const AutoOptions& options) {
  return std::make_unique<Auto>("auto", auto_table(), options);
}

Method auto_method() {
  return method_row<auto_table, make_auto>(
      "auto",
      "measures the noise of each joint or marker, repairs spikes, smooths by the measured "
      "noise, and leaves clean takes unchanged",
      "Kinemend; smoothing by evidence after Eilers 2003 and Wahba 1985");
}

}  // namespace kinemend
