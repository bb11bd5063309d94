// Measures removals in moving windows and scales them down to the floor of their track. A stream
// keeps half a second of removals and sixteen seconds of their levels.
#include "methods/learned/noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Squared lengths of what an estimate removes from a track, one per frame.
std::vector<double> removals_of(const MotionTake& take, const std::vector<float>& estimate,
                                std::size_t track) {
  std::vector<double> squares(take.frames);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const std::size_t first = f * take.channels + 3 * track;
    for (std::size_t i = first; i < first + 3; ++i) {
      const double change = static_cast<double>(estimate[i] - take.values[i]);
      squares[f] += change * change;
    }
  }
  return squares;
}

// Root mean squares over the measured frames of the window about each frame; windows are cut at the
// ends of the take. A window without measured frames has 0.
std::vector<double> windowed(const MotionTake& take, const std::vector<double>& squares,
                             std::size_t track, std::size_t reach) {
  const std::size_t frames = take.frames;
  std::vector<double> sums(frames + 1), counts(frames + 1);
  for (std::size_t f = 0; f < frames; ++f) {
    const bool is_missing = take.is_missing(f, 3 * track);
    sums[f + 1] = sums[f] + (is_missing ? 0 : squares[f]);
    counts[f + 1] = counts[f] + (is_missing ? 0 : 1);
  }
  std::vector<double> means(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t first = f - std::min(f, reach), last = std::min(f + reach + 1, frames);
    const double count = counts[last] - counts[first];
    if (count > 0) means[f] = std::sqrt(std::max(0.0, sums[last] - sums[first]) / count);
  }
  return means;
}

// Marks frames about which a track loses white noise: then most of its changes within a 60th of a
// second are large, while a step or a flip makes only few of them large.
class Bursts {
 public:
  Bursts(const MotionTake& take, const std::vector<float>& values, std::size_t track,
         std::size_t reach)
      : reach_(reach) {
    const auto lag = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(burst_lag_s * take.frame_rate_hz)));
    for (std::size_t f = lag; f < take.frames; ++f) {
      if (take.is_missing(f, 3 * track) || take.is_missing(f - lag, 3 * track)) continue;
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t now = f * take.channels + 3 * track + axis,
                          then = now - lag * take.channels;
        const auto change = static_cast<double>((values[now] - take.values[now]) -
                                                (values[then] - take.values[then]));
        square += change * change;
      }
      frames_.push_back(f);
      changes_.push_back(0.5 * square);
    }
  }

  bool is_within(std::size_t frame, double root_mean_square) {
    // One quartile is computed for all frames of a quarter of a window.
    const std::size_t part = frame / std::max<std::size_t>(1, reach_ / 2);
    if (part != part_ || !quartile_known_) {
      part_ = part;
      quartile_known_ = true;
      quartile_ = quartile_about(frame);
    }
    return quartile_ > least_burst_share * root_mean_square * root_mean_square;
  }

 private:
  double quartile_about(std::size_t frame) {
    const std::size_t first = frame - std::min(frame, reach_);
    const auto from = std::lower_bound(frames_.begin(), frames_.end(), first);
    const auto to = std::upper_bound(from, frames_.end(), frame + reach_);
    window_.assign(changes_.begin() + (from - frames_.begin()),
                   changes_.begin() + (to - frames_.begin()));
    constexpr double quartile = 0.25;  // by definition
    return quantile_of(window_, quartile);
  }

  std::size_t reach_;
  std::vector<std::size_t> frames_;
  std::vector<double> changes_, window_;
  std::size_t part_ = 0;
  bool quartile_known_ = false;
  double quartile_ = 0;
};

bool is_long(const MotionTake& take) {
  return static_cast<double>(take.frames) >= shortest_floor_s * take.frame_rate_hz;
}

bool differs(const MotionTake& take, const std::vector<float>& other, std::size_t track) {
  for (std::size_t f = 0; f < take.frames; ++f) {
    const std::size_t first = f * take.channels + 3 * track;
    for (std::size_t i = first; i < first + 3; ++i)
      if (other[i] != take.values[i]) return true;
  }
  return false;
}

bool moves(const MotionTake& take, std::size_t track) {
  for (std::size_t i = take.channels; i < take.frames * take.channels; i += take.channels) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c)
      if (take.values[i + c] != take.values[c]) return true;
  }
  return false;
}

std::size_t window_reach(const MotionTake& take) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(0.5 * floor_window_s * take.frame_rate_hz)));
}

std::vector<double> of_measured_frames(const MotionTake& take, const std::vector<double>& all,
                                       std::size_t track) {
  std::vector<double> measured;
  measured.reserve(all.size());
  for (std::size_t f = 0; f < take.frames; ++f)
    if (!take.is_missing(f, 3 * track)) measured.push_back(all[f]);
  return measured;
}

// Whether the smoothing by the measured noise changes a track.
bool is_measured(const MotionTake& take, std::size_t track) {
  return !take.measured.empty() && differs(take, take.measured, track);
}

bool has_floor(const MotionTake& take, const MotionResult& result, bool is_stepped,
               std::size_t track) {
  if (!is_worth_a_change(track_error(take, result, track))) return false;
  if (is_stepped && !is_measured(take, track)) return false;
  std::vector<double> lost = of_measured_frames(
      take, windowed(take, removals_of(take, result.values, track), track, window_reach(take)),
      track);
  double square = 0;
  for (const double one : lost) square += one * one / static_cast<double>(lost.size());
  return quantile_of(lost, floor_share) > least_floor_share * std::sqrt(square);
}

bool is_noisy_take(const MotionTake& take, std::span<const std::uint8_t> is_stepped,
                   const MotionResult& result) {
  const std::size_t tracks = take.channels / 3;
  // In takes of joints only those that turn are counted: the network does not clean their
  // positions.
  const bool has_joints =
      std::find(take.is_position.begin(), take.is_position.end(), 0) != take.is_position.end();
  std::vector<std::uint8_t> counts(tracks), noisy(tracks);
  for_each_parallel(tracks, take.values.size(), [&](std::size_t n) {
    if ((has_joints && take.is_position[3 * n] != 0) || !moves(take, n)) return;
    counts[n] = 1;
    noisy[n] = has_floor(take, result, is_stepped[n] != 0, n) ? 1 : 0;
  });
  const auto all = static_cast<double>(std::count(counts.begin(), counts.end(), 1)),
             with_floor = static_cast<double>(std::count(noisy.begin(), noisy.end(), 1));
  return all >= static_cast<double>(fewest_noisy_tracks) && with_floor >= least_noisy_share * all;
}

// Whether the measured noise is more than a fast move.
bool has_measured_noise(const MotionTake& take, bool is_known, std::size_t track) {
  if (!is_measured(take, track)) return false;
  return is_known || is_long(take) || take.frame_rate_hz >= lowest_burst_rate_hz ||
         take.is_position[3 * track] != 0;
}

// Bounds the removals of a track. Returns the root mean square per axis of what was put back.
double bound_track(const MotionTake& take, bool is_known, bool is_stepped, std::size_t track,
                   MotionResult& result) {
  const std::size_t frames = take.frames, reach = window_reach(take);
  const bool is_noisy = has_measured_noise(take, is_known, track);
  const std::vector<double> squares = removals_of(take, result.values, track);
  const std::vector<double> lost = windowed(take, squares, track, reach);
  std::vector<double> asked(frames);
  if (is_noisy) asked = windowed(take, removals_of(take, take.measured, track), track, reach);
  double floor = 0;
  if (!is_stepped && (is_known || is_noisy || is_long(take))) {
    std::vector<double> all = of_measured_frames(take, lost, track);
    floor = most_floors * quantile_of(all, floor_share);
  }
  std::optional<Bursts> bursts;
  // Steps change as quickly as noise.
  if (take.frame_rate_hz >= lowest_burst_rate_hz && !is_stepped)
    bursts.emplace(take, result.values, track, reach);
  double put_back = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double most = std::max(floor, asked[f]);
    if (lost[f] <= most || (bursts && bursts->is_within(f, lost[f]))) continue;
    const double left = most / lost[f];
    put_back += (1 - left) * (1 - left) * squares[f];
    const std::size_t first = f * take.channels + 3 * track;
    for (std::size_t i = first; i < first + 3; ++i)
      result.values[i] =
          take.values[i] + static_cast<float>(left) * (result.values[i] - take.values[i]);
  }
  return std::sqrt(put_back / (3 * static_cast<double>(frames)));
}

}  // namespace

std::vector<double> keep_to_noise_floor(const MotionTake& take,
                                        std::span<const std::uint8_t> is_known,
                                        std::span<const std::uint8_t> is_stepped,
                                        MotionResult& result) {
  std::vector<double> put_back(take.channels / 3);
  if (is_noisy_take(take, is_stepped, result)) return put_back;
  for_each_parallel(put_back.size(), take.values.size(), [&](std::size_t track) {
    put_back[track] =
        bound_track(take, is_known[track] != 0, is_stepped[track] != 0, track, result);
  });
  return put_back;
}

std::vector<std::uint8_t> stepped_tracks(const TakeView& take,
                                         std::span<const std::size_t> numbers) {
  std::vector<std::uint8_t> stepped;
  for (const std::size_t number : numbers) {
    const Track& track = take.tracks[number];
    std::size_t repeated = 0;
    for (std::size_t f = 1; f < take.frames; ++f) {
      const bool is_same = track.space == Space::rotation
                               ? track.rotation(f) == track.rotation(f - 1)
                               : track.position(f) == track.position(f - 1);
      if (is_same) ++repeated;
    }
    const double share = static_cast<double>(repeated) / static_cast<double>(take.frames);
    stepped.push_back(share >= least_stepped_share ? 1 : 0);
  }
  return stepped;
}

TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track) {
  const std::size_t later = frames_of_quick_noise(take.frame_rate_hz);
  TrackError error;
  const auto change = [&](std::size_t i) {
    return static_cast<double>(result.values[i] - take.values[i]);
  };
  double samples = 0;  // samples of moving axes
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      const std::size_t i = f * take.channels + c;
      if (result.deviation[i] == 0 && change(i) == 0) continue;
      samples += 1;
      error.removed += change(i) * change(i);
      error.left += static_cast<double>(result.deviation[i]) * result.deviation[i];
      if (f < later) continue;
      const double difference = change(i) - change(i - later * take.channels);
      error.quick += 0.5 * difference * difference;
    }
  }
  samples = std::max(samples, 1.0);
  error.removed /= samples, error.left /= samples, error.quick /= samples;
  if (error.removed > error.quick)
    error.correlation =
        portable::pow(1 - error.quick / error.removed, 1 / static_cast<double>(later));
  return error;
}

bool is_worth_a_change(const TrackError& error) {
  // Smallest ratio of the removed deviation to the remaining one. Chosen by hand
  // (docs/methods/learned.md), not swept.
  constexpr double least_share = 0.1;
  return error.removed > least_share * least_share * error.left;
}

ColouredNoise removed_noise(std::span<const TrackError> errors) {
  std::vector<double> strengths, correlations;
  for (const TrackError& error : errors) {
    if (!is_worth_a_change(error)) continue;
    strengths.push_back(std::sqrt(error.removed));
    correlations.push_back(error.correlation);
  }
  if (strengths.empty()) return {};
  return {median_of(strengths), median_of(correlations)};
}

double slow_noise(std::span<const TrackError> errors) {
  // Smallest reported noise, degrees, and the largest share of its variance that changes within 40
  // ms. Chosen by hand, not swept.
  constexpr double least_deg = 1, most_quick_share = 0.25;
  std::vector<double> sizes, quick;
  for (const TrackError& error : errors) {
    if (error.left == 0 || !is_worth_a_change(error)) continue;
    sizes.push_back(std::sqrt(error.all()));
    quick.push_back(error.quick / error.all());
  }
  if (sizes.empty()) return 0;
  const double size = median_of(sizes);
  return size >= least_deg && median_of(quick) <= most_quick_share ? size : 0;
}

namespace {

// Levels per second, and how many of them are kept: 16 seconds. Chosen by hand: longer than a dance
// step, shorter than a change of the light before a camera.
constexpr double levels_hz = 8;
constexpr std::size_t kept_levels = 128;
// Before that the levels of a stream are too few. Chosen by hand.
constexpr double shortest_noisy_s = 3;
// Half of this is the longest spike. Chosen by hand: two frames of 120 Hz.
constexpr double longest_spike_s = 0.04;
constexpr double quartile = 0.25;  // by definition

std::size_t frames_of(double seconds, double frame_rate_hz) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(seconds * frame_rate_hz)));
}

}  // namespace

LiveNoiseFloor::LiveNoiseFloor(double frame_rate_hz, std::vector<std::uint8_t> counts)
    : frame_rate_hz_(frame_rate_hz),
      counts_(std::move(counts)),
      moves_(counts_.size()),
      first_(3 * counts_.size()),
      tracks_(counts_.size()),
      window_(frames_of(floor_window_s, frame_rate_hz)),
      lag_(frames_of(burst_lag_s, frame_rate_hz)),
      hop_(frames_of(1 / levels_hz, frame_rate_hz)),
      spike_(std::max<std::size_t>(3, frames_of(longest_spike_s, frame_rate_hz))),
      last_(spike_ * tracks_),
      removals_(window_ * tracks_ * 3),
      squares_(window_ * tracks_),
      changes_(window_ * tracks_),
      sums_(tracks_),
      lost_(tracks_),
      levels_(kept_levels * tracks_),
      floors_(tracks_),
      quartiles_(tracks_) {
  sorted_.reserve(std::max(window_, kept_levels));
}

// The median of the last squares. It excludes spikes, which the network removes, from the level.
double LiveNoiseFloor::middle_of_last(std::size_t track) {
  sorted_.clear();
  for (std::size_t i = 0; i < std::min(frames_, spike_); ++i)
    sorted_.push_back(last_[i * tracks_ + track]);
  return median_of(sorted_);
}

// Computes the floor of a track from the levels so far.
bool LiveNoiseFloor::has_floor(std::size_t track, double& floor) {
  sorted_.clear();
  double square = 0;
  const std::size_t count = std::min(frames_ / hop_, kept_levels);
  for (std::size_t i = 0; i < count; ++i) {
    sorted_.push_back(levels_[i * tracks_ + track]);
    square += sorted_.back() * sorted_.back() / static_cast<double>(count);
  }
  floor = quantile_of(sorted_, floor_share);
  return floor > least_floor_share * std::sqrt(square);
}

// Updates the floors, the quartiles of the last changes, and whether the stream is noisy, once per
// hop.
void LiveNoiseFloor::look_back(bool is_known, std::span<const std::uint8_t> may_be_known) {
  const auto has_passed = [&](double seconds) {
    return static_cast<double>(frames_) >= seconds * frame_rate_hz_;
  };
  std::size_t moving = 0, noisy = 0;
  for (std::size_t n = 0; n < tracks_; ++n) {
    double floor = 0;
    const bool is_noisy = has_floor(n, floor);
    if (counts_[n] != 0 && moves_[n] != 0) {
      ++moving;
      if (is_noisy) ++noisy;
    }
    const bool counts = has_passed(shortest_floor_s) || (is_known && may_be_known[n] != 0);
    floors_[n] = counts ? most_floors * floor : 0;
    if (frame_rate_hz_ < lowest_burst_rate_hz) continue;
    sorted_.clear();
    for (std::size_t i = 0; i < std::min(frames_, window_); ++i)
      sorted_.push_back(changes_[i * tracks_ + n]);
    quartiles_[n] = quantile_of(sorted_, quartile);
  }
  is_noisy_ = has_passed(shortest_noisy_s) && moving >= fewest_noisy_tracks &&
              static_cast<double>(noisy) >= least_noisy_share * static_cast<double>(moving);
}

void LiveNoiseFloor::bound(std::span<const float> samples, bool is_known,
                           std::span<const std::uint8_t> may_be_known, std::span<float> cleaned) {
  const std::size_t now = frames_ % window_, before = (frames_ + window_ - lag_) % window_;
  if (frames_ == 0) std::copy(samples.begin(), samples.end(), first_.begin());
  ++frames_;
  const bool is_hop = frames_ % hop_ == 0;
  const auto count = static_cast<double>(std::min(frames_, window_));
  for (std::size_t n = 0; n < tracks_; ++n) {
    float* const removal = removals_.data() + (now * tracks_ + n) * 3;
    const float* const earlier = removals_.data() + (before * tracks_ + n) * 3;
    double square = 0, change = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t c = 3 * n + axis;
      const float lost = cleaned[c] - samples[c];
      const double step = frames_ > lag_ ? static_cast<double>(lost - earlier[axis]) : 0;
      removal[axis] = lost;
      square += static_cast<double>(lost) * static_cast<double>(lost);
      change += 0.5 * step * step;
      if (samples[c] != first_[c]) moves_[n] = 1;
    }
    last_[(frames_ - 1) % spike_ * tracks_ + n] = square;
    square = middle_of_last(n);
    sums_[n] += square - squares_[now * tracks_ + n];
    squares_[now * tracks_ + n] = square;
    changes_[now * tracks_ + n] = change;
    lost_[n] = std::sqrt(std::max(0.0, sums_[n]) / count);
    if (is_hop) levels_[(frames_ / hop_ - 1) % kept_levels * tracks_ + n] = lost_[n];
  }
  if (is_hop) look_back(is_known, may_be_known);
  if (is_noisy_) return;
  // Before the first floor, a body that the model knows is not bounded.
  const bool has_floors = frames_ >= hop_;
  for (std::size_t n = 0; n < tracks_; ++n) {
    if (!has_floors && is_known && may_be_known[n] != 0) continue;
    if (floors_[n] > 0 && lost_[n] <= floors_[n]) continue;
    if (quartiles_[n] > least_burst_share * lost_[n] * lost_[n]) continue;
    const auto left = floors_[n] > 0 ? static_cast<float>(floors_[n] / lost_[n]) : 0.0F;
    for (std::size_t c = 3 * n; c < 3 * n + 3; ++c)
      cleaned[c] = samples[c] + left * (cleaned[c] - samples[c]);
  }
}

}  // namespace kinemend
