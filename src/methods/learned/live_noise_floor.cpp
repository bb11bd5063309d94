// Keeps half a second of removals and sixteen seconds of their levels.
#include "methods/learned/live_noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"

namespace kinemend {

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
