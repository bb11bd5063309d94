#include "clean/spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "clean/spike_trial.hpp"
#include "clean/tracks.hpp"
#include "signal/whittaker.hpp"

namespace kinemend {

namespace {

constexpr double least_noise =
    0.25;  // degrees: what a spike is measured against on a noiseless track
constexpr double accused_ratio = 6.5;  // prediction error over its standard deviation
constexpr double robust_cap = 6;  // errors count for no more than this many standard deviations
constexpr int rounds = 5;

// Second-order smoothers over a coarse grid of cutoffs, and the weight of each sample in its own
// fit.
struct LeaveOneOutGrid {
  std::vector<signal::SharedFactor> factors;
  std::vector<std::vector<double>> own_shares;  // weights of all others

  LeaveOneOutGrid(std::size_t frames, double frame_rate_hz) {
    constexpr std::size_t order = 2, cutoffs = 10;
    constexpr double lowest_hz = 0.3, highest_hz = 30, largest_strength = 1e10;
    if (frames <= order + 1) return;
    for (std::size_t i = 0; i < cutoffs; ++i) {
      const double cutoff =
          lowest_hz * std::pow(highest_hz / lowest_hz, static_cast<double>(i) / (cutoffs - 1));
      const double strength =
          signal::strength_of_cutoff(std::min(cutoff / frame_rate_hz, 0.49), order);
      if (strength > largest_strength) continue;
      factors.push_back(signal::factor_shared(frames, order, strength));
      own_shares.push_back(signal::weights_of_others(factors.back()));
      for (double& share : own_shares.back()) share = std::max(share, 1e-3);
    }
  }
};

constexpr std::size_t tracks_in_block = signal::block_channels / 3;

signal::ChannelBlock gather_tracks(const VectorTracks& tracks, std::size_t first,
                                   std::size_t count) {
  signal::ChannelBlock block(tracks.frames());
  for (std::size_t t = 0; t < tracks.frames(); ++t) {
    const double* row = tracks.values.values.data() + t * tracks.values.channels + 3 * first;
    for (std::size_t i = 0; i < 3 * count; ++i) block(t, i) = row[i];
  }
  return block;
}

Vec3 block_vector(const signal::ChannelBlock& block, std::size_t frame, std::size_t track) {
  return {block(frame, 3 * track), block(frame, 3 * track + 1), block(frame, 3 * track + 2)};
}

// `filled` is the measured tracks with marked samples interpolated: a marked sample's fit is its
// prediction.
Predictions predict(const VectorTracks& measured, const VectorTracks& filled,
                    const SampleMarks& marked, const std::vector<double>& noise,
                    const LeaveOneOutGrid& grid) {
  const std::size_t frames = measured.frames(), tracks = measured.tracks();
  Predictions result{PoseMatrix(frames, tracks), PoseMatrix(frames, tracks, 1.0)};
  const std::size_t blocks = (tracks + tracks_in_block - 1) / tracks_in_block;
  for_each_parallel(blocks, measured.values.values.size(), [&](std::size_t b) {
    const std::size_t first = b * tracks_in_block,
                      count = std::min(tracks_in_block, tracks - first);
    const signal::ChannelBlock y = gather_tracks(filled, first, count);
    signal::ChannelBlock x(frames);
    std::array<double, tracks_in_block> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (std::size_t g = 0; g < grid.factors.size(); ++g) {
      signal::solve_shared(grid.factors[g], y, x);
      const std::vector<double>& own = grid.own_shares[g];
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t n = first + i;
        const double scale = std::max(noise[n], least_noise);
        const double cap = robust_cap * scale * robust_cap * scale;
        double score = 0;
        for (std::size_t t = 0; t < frames; ++t) {
          const Vec3 error = (1 / own[t]) * (block_vector(y, t, i) - block_vector(x, t, i));
          score += std::min(dot(error, error), cap);
        }
        if (score >= least[i]) continue;
        least[i] = score;
        for (std::size_t t = 0; t < frames; ++t) {
          const Vec3 fit = block_vector(x, t, i), given = block_vector(y, t, i);
          const Vec3 predicted = marked(t, n) != 0 ? fit : given - (1 / own[t]) * (given - fit);
          result.errors(t, n) = norm(measured.at(t, n) - predicted);
          result.own_shares(t, n) = own[t];
        }
      }
    }
  });
  return result;
}

// Median of a track of values about each frame, the take mirrored at its ends.
std::vector<double> running_median(const std::vector<double>& values, std::size_t half) {
  const auto frames = static_cast<std::ptrdiff_t>(values.size());
  const auto reach = std::min(static_cast<std::ptrdiff_t>(half), (frames - 1) / 2);
  const auto mirrored = [&](std::ptrdiff_t t) {
    if (t < 0) t = -t;
    if (t >= frames) t = 2 * (frames - 1) - t;
    return values[static_cast<std::size_t>(t)];
  };
  std::vector<double> window, result(values.size());
  for (std::ptrdiff_t t = -reach; t <= reach; ++t) window.push_back(mirrored(t));
  std::sort(window.begin(), window.end());
  for (std::ptrdiff_t t = 0; t < frames; ++t) {
    result[static_cast<std::size_t>(t)] = window[static_cast<std::size_t>(reach)];
    if (t + 1 == frames) break;
    window.erase(std::lower_bound(window.begin(), window.end(), mirrored(t - reach)));
    const double next = mirrored(t + 1 + reach);
    window.insert(std::lower_bound(window.begin(), window.end(), next), next);
  }
  return result;
}

// The next round's suspects: of those accused before, whoever still does not fit; of the others,
// the worst within two frames.
SampleMarks accuse(const Predictions& predictions, const SampleMarks& accused,
                   const std::vector<double>& noise, double frame_rate_hz) {
  SampleMarks next(accused.frames, accused.tracks);
  const auto half = static_cast<std::size_t>(std::lround(0.08 * frame_rate_hz));
  for_each_parallel(accused.tracks, accused.marks.size(), [&](std::size_t n) {
    const double scale = std::max(noise[n], least_noise);
    std::vector<double> ratio(accused.frames), unaccused(accused.frames);
    for (std::size_t t = 0; t < accused.frames; ++t) {
      ratio[t] = predictions.errors(t, n) * std::sqrt(predictions.own_shares(t, n)) / scale;
      unaccused[t] = accused(t, n) != 0 ? 0 : ratio[t];
    }
    const std::vector<double> usual = running_median(unaccused, half);
    for (std::size_t t = 0; t < accused.frames; ++t) {
      const bool stands_out = ratio[t] > accused_ratio * std::max(1.0, usual[t] / median_of_chi3) &&
                              predictions.errors(t, n) > least_deviation;
      if (!stands_out) continue;
      const std::size_t first = t < 2 ? 0 : t - 2, last = std::min(t + 3, accused.frames);
      const auto from = unaccused.begin();
      const double worst = *std::max_element(from + static_cast<std::ptrdiff_t>(first),
                                             from + static_cast<std::ptrdiff_t>(last));
      next(t, n) = accused(t, n) != 0 || unaccused[t] >= worst;
    }
  });
  return next;
}

// The accused, and the gaps whose bridges rest on one of them.
SampleMarks with_bridges_beside(const SampleMarks& accused, const SampleMarks& missing) {
  SampleMarks result = accused;
  for (std::size_t n = 0; n < accused.tracks; ++n) {
    for (std::size_t t = 0; t < accused.frames;) {
      if (missing(t, n) == 0) {
        ++t;
        continue;
      }
      const std::size_t first = t;
      while (t < accused.frames && missing(t, n) != 0) ++t;
      const bool rests_on_accused =
          (first > 0 && accused(first - 1, n) != 0) || (t < accused.frames && accused(t, n) != 0);
      for (std::size_t f = first; rests_on_accused && f < t; ++f) result(f, n) = 1;
    }
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> joints_nearby(std::span<const std::int32_t> parents) {
  const std::size_t count = parents.size();
  std::vector<std::vector<std::size_t>> neighbours(count), nearby(count);
  for (std::size_t j = 0; j < count; ++j) {
    if (parents[j] < 0) continue;
    const auto parent = static_cast<std::size_t>(parents[j]);
    neighbours[j].push_back(parent);
    neighbours[parent].push_back(j);
  }
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<std::uint8_t> seen(count);
    seen[j] = 1;
    std::vector<std::size_t> ring{j};
    for (int bones = 0; bones < 3; ++bones) {
      std::vector<std::size_t> next;
      for (const std::size_t from : ring) {
        for (const std::size_t to : neighbours[from]) {
          if (std::exchange(seen[to], std::uint8_t{1}) == 0) next.push_back(to);
        }
      }
      nearby[j].insert(nearby[j].end(), next.begin(), next.end());
      ring = std::move(next);
    }
  }
  return nearby;
}

SpikeVerdicts find_spikes(VectorTracks& tracks, const SampleMarks& suspects,
                          const std::vector<std::vector<std::size_t>>& nearby, double frame_rate_hz,
                          const SampleMarks* missing) {
  const std::size_t frames = tracks.frames(), count = tracks.tracks();
  if (frames < 6) {
    return {SampleMarks(frames, count), std::vector<double>(count)};
  }
  const LeaveOneOutGrid grid(frames, frame_rate_hz);
  const VectorTracks measured = tracks;
  SampleMarks accused = suspects;
  const auto refill = [&] {
    tracks = measured;
    fill_marked(tracks, missing ? with_bridges_beside(accused, *missing) : accused);
  };
  const auto noise_without_accused = [&] {
    return noise_levels(measured, missing ? either(accused, *missing) : accused);
  };
  refill();
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> noise = noise_without_accused();
    const Predictions predictions = predict(measured, tracks, accused, noise, grid);
    SampleMarks next = accuse(predictions, accused, noise, frame_rate_hz);
    for (std::size_t i = 0; missing && i < next.marks.size(); ++i) {
      if (missing->marks[i] != 0) next.marks[i] = 0;
    }
    if (next == accused) break;
    accused = std::move(next);
    refill();
  }
  std::vector<double> noise = noise_without_accused();
  const std::vector<double> shares = cleaning_shares(noise, frame_rate_hz);
  const Predictions predictions = predict(measured, tracks, accused, noise, grid);
  accused =
      judge_spikes({measured, predictions, accused, noise, shares, nearby, frame_rate_hz, missing});
  refill();
  noise = noise_without_accused();
  return {std::move(accused), std::move(noise)};
}

}  // namespace kinemend
