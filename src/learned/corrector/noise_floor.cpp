// Measures removals in moving windows and scales them down to the floor of their track.
#include "learned/corrector/noise_floor.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Squared lengths of what an estimate takes out of a track, one a frame.
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

// Root mean squares in the window about each frame that is measured; windows end where the take
// ends. A window without measured frames has 0.
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

// Marks frames about which a track loses white noise: most of its changes within a 60th of a second
// are large, while a step or a flip makes few of them so.
class Bursts {
 public:
  Bursts(const MotionTake& take, const std::vector<float>& values, std::size_t track,
         std::size_t reach)
      : take_(take), reach_(reach) {
    const auto lag =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(take.frame_rate_hz / 60)));
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
    // The quartile of a window serves all frames of a quarter of it.
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

  const MotionTake& take_;
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

// One a track, 1 where the measurement finds noise that is no fast motion.
std::vector<std::uint8_t> noisy_tracks(const MotionTake& take,
                                       std::span<const std::uint8_t> is_known) {
  std::vector<std::uint8_t> noisy(take.channels / 3);
  if (take.measured.empty()) return noisy;
  double turning = 0, turning_noisy = 0;
  for (std::size_t n = 0; n < noisy.size(); ++n) {
    noisy[n] = differs(take, take.measured, n) ? 1 : 0;
    if (take.is_position[3 * n] != 0 || !moves(take, n)) continue;
    turning += 1;
    turning_noisy += noisy[n];
  }
  if (is_long(take) || take.frame_rate_hz >= lowest_burst_rate_hz ||
      turning_noisy >= least_noisy_share * turning)
    return noisy;
  for (std::size_t n = 0; n < noisy.size(); ++n)
    if (take.is_position[3 * n] == 0 && is_known[n] == 0) noisy[n] = 0;
  return noisy;
}

// Returns the root mean square per axis of what the track gets back.
double bound_track(const MotionTake& take, bool is_known, bool is_noisy, std::size_t track,
                   MotionResult& result) {
  const std::size_t frames = take.frames;
  const auto reach = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(0.5 * floor_window_s * take.frame_rate_hz)));
  const std::vector<double> squares = removals_of(take, result.values, track);
  const std::vector<double> lost = windowed(take, squares, track, reach);
  std::vector<double> asked(frames);
  if (is_noisy) asked = windowed(take, removals_of(take, take.measured, track), track, reach);
  double floor = 0;
  if (is_known || is_noisy || is_long(take)) {
    std::vector<double> all;
    for (std::size_t f = 0; f < frames; ++f)
      if (!take.is_missing(f, 3 * track)) all.push_back(lost[f]);
    floor = most_floors * quantile_of(all, floor_share);
  }
  Bursts bursts(take, result.values, track, reach);
  const bool may_burst = take.frame_rate_hz >= lowest_burst_rate_hz;
  double put_back = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double most = std::max(floor, asked[f]);
    if (lost[f] <= most || (may_burst && bursts.is_within(f, lost[f]))) continue;
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
                                        MotionResult& result) {
  std::vector<double> put_back(take.channels / 3);
  const std::vector<std::uint8_t> is_noisy = noisy_tracks(take, is_known);
  for_each_parallel(put_back.size(), take.values.size(), [&](std::size_t track) {
    put_back[track] = bound_track(take, is_known[track] != 0, is_noisy[track] != 0, track, result);
  });
  return put_back;
}

}  // namespace kinemend
