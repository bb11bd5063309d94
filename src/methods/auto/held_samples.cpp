// Finds the pattern of held or interpolated samples, and expands cleaned measurements to all
// frames.
#include "methods/auto/held_samples.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Frames of a period, for speed; not swept.
constexpr std::size_t longest_step = 8;  // limits time and memory

// Sizes of the differences of order 1 or 2 by the frame at which they show a new measurement.
std::vector<std::optional<double>> difference_sizes(std::span<const Vec3> track,
                                                    std::span<const std::uint8_t> missing,
                                                    SampleJoin join) {
  std::vector<std::optional<double>> sizes(track.size());
  for (std::size_t t = 1; t + (join == SampleJoin::linear ? 1 : 0) < track.size(); ++t) {
    if (missing[t - 1] != 0 || missing[t] != 0) continue;
    if (join == SampleJoin::held) {
      sizes[t] = norm(track[t] - track[t - 1]);
    } else if (missing[t + 1] == 0) {
      sizes[t] = norm((track[t + 1] - track[t]) - (track[t] - track[t - 1]));
    }
  }
  return sizes;
}

// The only phase with large differences, if there is one: their median is large there, and hardly
// any of another phase are large, except at spikes.
std::optional<std::size_t> lone_phase(const std::vector<std::optional<double>>& sizes,
                                      std::size_t step, const HeldTuning& tuning) {
  std::array<double, longest_step> usual{}, large{};
  std::vector<double> of_phase;
  for (std::size_t phase = 0; phase < step; ++phase) {
    of_phase.clear();
    for (std::size_t t = phase; t < sizes.size(); t += step) {
      if (sizes[t]) of_phase.push_back(*sizes[t]);
    }
    if (of_phase.size() < tuning.fewest_samples) return std::nullopt;
    usual[phase] = quantile_of(of_phase, 0.5);
    large[phase] = quantile_of(of_phase, tuning.large_quantile);
  }
  const auto lone =
      static_cast<std::size_t>(std::max_element(usual.begin(), usual.end()) - usual.begin());
  for (std::size_t phase = 0; phase < step; ++phase) {
    if (phase != lone && large[phase] > tuning.largest_ratio * usual[lone]) return std::nullopt;
  }
  return usual[lone] > tuning.least_difference ? std::optional(lone) : std::nullopt;
}

bool moves(const std::vector<std::optional<double>>& sizes, const HeldTuning& tuning) {
  std::size_t moving = 0;
  for (const auto& size : sizes) moving += size && *size > tuning.least_difference;
  return moving * 2 * longest_step > sizes.size();
}

bool agree(std::size_t votes, std::size_t all, const HeldTuning& tuning) {
  return static_cast<double>(votes) >= tuning.agreeing_tracks * static_cast<double>(all);
}

// How many tracks show each pattern of one join, by step and phase, and how many show none of a
// step.
struct Votes {
  const HeldTuning& tuning;
  std::size_t moving = 0;
  std::array<std::array<std::size_t, longest_step>, longest_step + 1> votes{};
  std::array<std::size_t, longest_step + 1> against{};

  // Whether enough of this many tracks may still agree on a step.
  bool is_open(std::size_t step, std::size_t tracks) const {
    return agree(tracks - against[step], tracks, tuning);
  }
  bool any_is_open(std::size_t tracks) const {
    for (std::size_t step = 2; step <= longest_step; ++step) {
      if (is_open(step, tracks)) return true;
    }
    return false;
  }
};

SamplePattern elected(const VectorTracks& tracks, const SampleMarks& missing, SampleJoin join,
                      const HeldTuning& tuning) {
  Votes count{tuning};
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    if (!count.any_is_open(tracks.tracks())) return {};
    const auto sizes = difference_sizes(tracks.track(n), missing.track(n), join);
    if (!moves(sizes, tuning)) continue;
    ++count.moving;
    for (std::size_t step = 2; step <= longest_step; ++step) {
      if (!count.is_open(step, tracks.tracks())) continue;
      if (const auto phase = lone_phase(sizes, step, tuning)) {
        ++count.votes[step][*phase];
      } else {
        ++count.against[step];
      }
    }
  }
  // Samples held for four frames also change at most at every second frame, so the longest step is
  // the right one.
  for (std::size_t step = longest_step; step >= 2; --step) {
    for (std::size_t phase = 0; phase < step; ++phase) {
      if (count.moving > 0 && agree(count.votes[step][phase], count.moving, tuning))
        return {join, static_cast<double>(step), static_cast<double>(phase)};
    }
  }
  return {};
}

// Frames, from the second on, that change on more than a tenth of the moving tracks; none if in
// some frame no such track was seen, or no track moves.
std::vector<std::size_t> new_frames(const VectorTracks& tracks, const SampleMarks& missing,
                                    const HeldTuning& tuning) {
  const double least_repeats = 0.5 * (1 - 1 / tuning.least_clock_step);
  std::size_t against = 0;
  std::vector<std::size_t> seen(tracks.frames()), repeats(tracks.frames());
  std::vector<double> values;
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    const auto sizes = difference_sizes(tracks.track(n), missing.track(n), SampleJoin::held);
    if (!moves(sizes, tuning)) continue;
    values.clear();
    for (const auto& size : sizes) {
      if (size) values.push_back(*size);
    }
    const double large = quantile_of(values, tuning.large_quantile);
    std::size_t repeated = 0;
    for (std::size_t t = 1; t < sizes.size(); ++t) {
      if (!sizes[t]) continue;
      ++seen[t];
      if (*sizes[t] > tuning.largest_ratio * large) continue;
      ++repeats[t];
      ++repeated;
    }
    if (static_cast<double>(repeated) < least_repeats * static_cast<double>(tracks.frames()))
      ++against;
    if (!agree(tracks.tracks() - against, tracks.tracks(), tuning)) return {};
  }
  std::vector<std::size_t> frames;
  for (std::size_t t = 1; t < tracks.frames(); ++t) {
    if (seen[t] == 0) return {};
    if (!agree(repeats[t], seen[t], tuning)) frames.push_back(t);
  }
  return frames;
}

// The start times of a clock with this step whose k-th tick is at most one frame before frames[k].
// The room, the latest less the earliest start, is below 0 if no start fits.
struct ClockStart {
  double earliest, latest;
  double room() const { return latest - earliest; }
};

ClockStart start_of_clock(std::span<const std::size_t> frames, double step) {
  ClockStart start{-std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double rest = static_cast<double>(frames[k]) - step * static_cast<double>(k);
    start.earliest = std::max(start.earliest, rest - 1);
    start.latest = std::min(start.latest, rest);
  }
  return start;
}

// The pattern of samples held for a fractional number of frames: all new frames fit one clock.
SamplePattern uneven_hold(const VectorTracks& tracks, const SampleMarks& missing,
                          const HeldTuning& tuning) {
  const std::vector<std::size_t> frames = new_frames(tracks, missing, tuning);
  if (frames.size() < tuning.fewest_samples ||
      tracks.frames() < frames.size() + tuning.fewest_samples)
    return {};
  const auto count = static_cast<double>(frames.size() - 1);
  const double mean = static_cast<double>(frames.back() - frames.front()) / count;
  if (mean < tuning.least_clock_step || mean > static_cast<double>(longest_step)) return {};
  // The room is concave in the step, so a ternary search finds its maximum.
  double low = mean - 1 / count, high = mean + 1 / count;
  for (int round = 0; round < 60; ++round) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (start_of_clock(frames, a).room() < start_of_clock(frames, b).room()) {
      low = a;
    } else {
      high = b;
    }
  }
  const double step = (low + high) / 2;
  const ClockStart start = start_of_clock(frames, step);
  if (start.room() <= 0) return {};
  double first = (start.earliest + start.latest) / 2;
  while (first - step > -1) first -= step;  // the sample shown before the first new frame
  return {SampleJoin::held, step, first};
}

// Second derivatives, per square of the samples' distance, of the natural cubic spline through
// them.
std::vector<Vec3> spline_curvatures(std::span<const Vec3> samples) {
  const std::size_t count = samples.size();
  std::vector<Vec3> curvatures(count);
  if (count < 3) return curvatures;
  std::vector<double> pivot(count);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    pivot[i] = 1 / (4 - pivot[i - 1]);
    const Vec3 bend = 6 * ((samples[i + 1] - samples[i]) - (samples[i] - samples[i - 1]));
    curvatures[i] = pivot[i] * (bend - curvatures[i - 1]);
  }
  for (std::size_t i = count - 2; i > 0; --i)
    curvatures[i] = curvatures[i] - pivot[i] * curvatures[i + 1];
  return curvatures;
}

// A frame's place among samples: `share` of the distance from `sample` to the next, outside of 0..1
// beyond the ends.
struct Place {
  std::size_t sample;
  double share;
};

Place place_of(std::size_t frame, std::size_t samples, const SamplePattern& pattern) {
  const std::size_t shown = pattern.samples(frame + 1);
  const std::size_t sample = std::min(shown > 0 ? shown - 1 : 0, samples - 2);
  return {sample, (static_cast<double>(frame) - pattern.time(sample)) / pattern.step};
}

Vec3 spline_at(std::span<const Vec3> samples, std::span<const Vec3> curvatures, Place place) {
  const std::size_t i = place.sample;
  const double b = place.share, a = 1 - b;
  const Vec3 line = a * samples[i] + b * samples[i + 1];
  // The spline continues linearly beyond the ends.
  if (b < 0) return line - (b / 6) * (2 * curvatures[i] + curvatures[i + 1]);
  if (b > 1) return line + ((b - 1) / 6) * (curvatures[i] + 2 * curvatures[i + 1]);
  return line + ((a * a - 1) * a / 6) * curvatures[i] + ((b * b - 1) * b / 6) * curvatures[i + 1];
}

// Joins the samples as the take did.
Vec3 joined_at(std::span<const Vec3> samples, SampleJoin join, Place place) {
  const std::size_t i = place.sample;
  if (join == SampleJoin::held) return samples[place.share >= 1 ? i + 1 : i];
  return samples[i] + place.share * (samples[i + 1] - samples[i]);
}

bool follows_from_marked(std::span<const std::uint8_t> marked, SampleJoin join, Place place) {
  const std::size_t i = place.sample;
  if (join == SampleJoin::held) return marked[place.share >= 1 ? i + 1 : i] != 0;
  return (marked[i] != 0 && place.share < 1) || (marked[i + 1] != 0 && place.share > 0);
}

}  // namespace

SamplePattern find_sample_pattern(const VectorTracks& tracks, const SampleMarks& missing,
                                  const HeldTuning& tuning) {
  SamplePattern pattern = elected(tracks, missing, SampleJoin::held, tuning);
  if (pattern.join == SampleJoin::none)
    pattern = elected(tracks, missing, SampleJoin::linear, tuning);
  if (pattern.join == SampleJoin::none) pattern = uneven_hold(tracks, missing, tuning);
  return pattern;
}

VectorTracks measured_samples(const VectorTracks& tracks, const SamplePattern& pattern) {
  return {pattern.samples(tracks.frames()), tracks.tracks(),
          [&](std::size_t i, std::size_t n) { return tracks.at(pattern.frame(i), n); }};
}

SampleMarks marks_of_samples(const SampleMarks& marks, const SamplePattern& pattern) {
  return {pattern.samples(marks.frames), marks.tracks,
          [&](std::size_t i, std::size_t n) { return marks(pattern.frame(i), n) != 0; }};
}

SampleMarks spread_samples(const VectorTracks& samples, const SampleMarks& marked,
                           const std::vector<double>& shares, const SamplePattern& pattern,
                           VectorTracks& tracks) {
  SampleMarks result(tracks.frames(), tracks.tracks());
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    const auto values = samples.track(n);
    const std::vector<Vec3> curvatures =
        shares[n] > 0 ? spline_curvatures(values) : std::vector<Vec3>();
    for (std::size_t t = 0; t < tracks.frames(); ++t) {
      const Place place = place_of(t, values.size(), pattern);
      result(t, n) = follows_from_marked(marked.track(n), pattern.join, place) ? 1 : 0;
      Vec3 value = result(t, n) != 0 ? joined_at(values, pattern.join, place) : tracks.at(t, n);
      if (shares[n] > 0) value += shares[n] * (spline_at(values, curvatures, place) - value);
      tracks.set(t, n, value);
    }
  });
  return result;
}

}  // namespace kinemend
