// Predicts each sample from the others of its track, and repeats this without the candidates until
// they no longer change.
#include "methods/auto/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "methods/auto/dense_outliers.hpp"
#include "methods/auto/spike_classification.hpp"
#include "signal/leave_one_out.hpp"

namespace kinemend {

namespace {

// State of the iteration; the candidates of a track depend on that track alone.
struct Detection {
  const VectorTracks& measured;
  double frame_rate_hz;
  const SampleMarks* missing;
  const signal::LeaveOneOut& smoothers;
  const TrackTuning& tuning;
  SampleMarks candidates;
  std::vector<std::uint8_t> dense;  // per track: 1 if its outliers are dense
  std::vector<double> noise;        // without the candidates
  Predictions predictions;

  std::vector<std::uint8_t> left_out(std::size_t track) const {
    const auto marks = candidates.track(track);
    std::vector<std::uint8_t> result(marks.begin(), marks.end());
    for (std::size_t t = 0; missing && t < result.size(); ++t) result[t] |= (*missing)(t, track);
    return result;
  }
};

// The candidates, and the bridged gaps that start or end at one.
std::vector<std::uint8_t> with_bridges_beside(std::span<const std::uint8_t> candidates,
                                              std::span<const std::uint8_t> missing) {
  std::vector<std::uint8_t> result(candidates.begin(), candidates.end());
  const std::size_t frames = candidates.size();
  for (std::size_t t = 0; t < frames;) {
    if (missing[t] == 0) {
      ++t;
      continue;
    }
    const std::size_t first = t;
    while (t < frames && missing[t] != 0) ++t;
    const bool touches_candidate =
        (first > 0 && candidates[first - 1] != 0) || (t < frames && candidates[t] != 0);
    for (std::size_t f = first; touches_candidate && f < t; ++f) result[f] = 1;
  }
  return result;
}

// Interpolates the candidates of a track, and the bridges that touch one, linearly.
void interpolate_candidates(const Detection& detection, std::size_t track, std::span<Vec3> filled) {
  const auto candidates = detection.candidates.track(track);
  if (detection.missing) {
    fill_marked(filled, with_bridges_beside(candidates, detection.missing->track(track)));
  } else {
    fill_marked(filled, candidates);
  }
}

void measure_noise(Detection& detection, std::size_t track) {
  detection.noise[track] =
      noise_level(detection.measured.track(track), detection.left_out(track),
                  detection.measured.is_whitened[track] != 0, detection.tuning.noise);
}

// Outliers that hide each other are the first candidates of their track. At low rates they must be
// on most tracks: a pop in one frame of ten may be a toe that leaves the ground at every step.
void start_at_dense_outliers(Detection& detection) {
  const VectorTracks& measured = detection.measured;
  std::vector<std::vector<std::uint8_t>> outliers(measured.tracks());
  for_each_parallel(measured.tracks(), measured.values.size(), [&](std::size_t n) {
    const std::span<const std::uint8_t> missing =
        detection.missing ? detection.missing->track(n) : std::span<const std::uint8_t>();
    outliers[n] =
        dense_outliers(measured.track(n), missing, detection.frame_rate_hz, detection.tuning.dense);
    detection.dense[n] = outliers[n].empty() ? 0 : 1;
  });
  AgreementTuning of_any_length = detection.tuning.agreement;
  of_any_length.shortest_s = std::numeric_limits<double>::infinity();
  if (agreement_of(measured, detection.dense, detection.frame_rate_hz, of_any_length) == 0)
    std::fill(detection.dense.begin(), detection.dense.end(), std::uint8_t{0});
  for (std::size_t n = 0; n < outliers.size(); ++n) {
    if (detection.dense[n] == 0) continue;
    std::copy(outliers[n].begin(), outliers[n].end(), detection.candidates.track(n).begin());
  }
}

double error_scale(const Detection& detection, std::size_t track) {
  return std::max(detection.noise[track], detection.tuning.spikes.noise_floor);
}

// The tracks, with their candidates interpolated.
signal::LaneBlock gather_tracks(const Detection& detection, std::span<const std::size_t> tracks) {
  signal::LaneBlock block(detection.measured.frames());
  std::vector<Vec3> filled;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto measured = detection.measured.track(tracks[i]);
    filled.assign(measured.begin(), measured.end());
    interpolate_candidates(detection, tracks[i], filled);
    for (std::size_t t = 0; t < filled.size(); ++t) {
      double* row = block.row(t) + i;
      row[0] = filled[t].x;
      row[signal::lane_tracks] = filled[t].y;
      row[2 * signal::lane_tracks] = filled[t].z;
    }
  }
  return block;
}

Vec3 lane_vector(const double* row, std::size_t lane) {
  return {row[lane], row[signal::lane_tracks + lane], row[2 * signal::lane_tracks + lane]};
}

// Predicts up to eight tracks, each by the smoother of least robust leave-one-out error. A
// candidate has no weight, so that its fit is its prediction.
void predict(Detection& detection, std::span<const std::size_t> tracks) {
  const signal::LaneBlock y = gather_tracks(detection, tracks);
  signal::BlockRow caps{};
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const double cap = detection.tuning.spikes.robust_cap * error_scale(detection, tracks[i]);
    caps[i] = cap * cap;
  }
  const auto best = detection.smoothers.best_smoothers(y, caps);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    detection.predictions.smoothers[tracks[i]] = best[i];
  for (std::size_t smoother = 0; smoother < detection.smoothers.smoothers(); ++smoother) {
    const auto last = best.begin() + static_cast<std::ptrdiff_t>(tracks.size());
    if (std::find(best.begin(), last, smoother) == last) continue;
    const std::vector<double>& weight = detection.smoothers.weights_of_others(smoother);
    detection.smoothers.fit(
        smoother, y, [&](std::size_t first, std::size_t count, const double* x) {
          for (std::size_t i = 0; i < tracks.size(); ++i) {
            if (best[i] != smoother) continue;
            const std::size_t n = tracks[i];
            for (std::size_t k = 0; k < count; ++k) {
              const std::size_t t = first + k;
              const Vec3 fit = lane_vector(x + k * signal::lane_row, i);
              const Vec3 given = lane_vector(y.row(t), i);
              const Vec3 predicted =
                  detection.candidates(t, n) != 0 ? fit : given - (1 / weight[t]) * (given - fit);
              detection.predictions.errors(t, n) = norm(detection.measured.at(t, n) - predicted);
            }
          }
        });
  }
}

// Median of values about frame t, the take mirrored at its ends.
double median_about(const std::vector<double>& values, std::size_t t, std::size_t half,
                    std::vector<double>& window) {
  const auto frames = static_cast<std::ptrdiff_t>(values.size());
  const auto reach = std::min(static_cast<std::ptrdiff_t>(half), (frames - 1) / 2);
  window.clear();
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    std::ptrdiff_t at = static_cast<std::ptrdiff_t>(t) + k;
    if (at < 0) at = -at;
    if (at >= frames) at = 2 * (frames - 1) - at;
    window.push_back(values[static_cast<std::size_t>(at)]);
  }
  return median_of(window);
}

// The next candidates of track n: earlier ones whose error still exceeds the threshold, and among
// the other samples the largest errors within two frames. Returns whether the set has changed.
bool update_candidates(Detection& detection, std::size_t n) {
  const SpikeTuning& tuning = detection.tuning.spikes;
  const std::size_t frames = detection.candidates.frames;
  const std::span<std::uint8_t> candidates = detection.candidates.track(n);
  if (detection.smoothers.smoothers() == 0) {
    const bool any = std::find(candidates.begin(), candidates.end(), 1) != candidates.end();
    std::fill(candidates.begin(), candidates.end(), std::uint8_t{0});
    return any;
  }
  const auto half = static_cast<std::size_t>(
      std::lround(tuning.median_half_s * window_rate_hz(detection.frame_rate_hz)));
  const double scale = error_scale(detection, n);
  const std::vector<double>& weight =
      detection.smoothers.weights_of_others(detection.predictions.smoothers[n]);
  std::vector<double> ratio(frames), others(frames), window;
  for (std::size_t t = 0; t < frames; ++t) {
    ratio[t] = detection.predictions.errors(t, n) * std::sqrt(weight[t]) / scale;
    others[t] = candidates[t] != 0 ? 0 : ratio[t];
  }
  std::vector<std::uint8_t> next(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    if (ratio[t] <= tuning.candidate_ratio ||
        detection.predictions.errors(t, n) <= tuning.least_error)
      continue;
    if (detection.missing && (*detection.missing)(t, n) != 0) continue;
    const double usual = median_about(others, t, half, window);
    if (ratio[t] <= tuning.candidate_ratio * std::max(1.0, usual / median_of_chi3)) continue;
    const std::size_t first = t < 2 ? 0 : t - 2, last = std::min(t + 3, frames);
    const auto from = others.begin();
    const double worst = *std::max_element(from + static_cast<std::ptrdiff_t>(first),
                                           from + static_cast<std::ptrdiff_t>(last));
    next[t] = candidates[t] != 0 || others[t] >= worst;
  }
  if (std::equal(next.begin(), next.end(), candidates.begin())) return false;
  std::copy(next.begin(), next.end(), candidates.begin());
  return true;
}

// Estimates the noise of these tracks and predicts their samples, eight tracks at a time.
void predict_tracks(Detection& detection, std::span<const std::size_t> tracks,
                    ShareProgress* progress = nullptr) {
  const std::size_t blocks = (tracks.size() + signal::lane_tracks - 1) / signal::lane_tracks;
  if (progress) progress->begin_part(0.4, blocks);
  for_each_parallel(blocks, tracks.size() * detection.measured.frames(), [&](std::size_t b) {
    const std::size_t first = b * signal::lane_tracks;
    const auto some = tracks.subspan(first, std::min(signal::lane_tracks, tracks.size() - first));
    for (const std::size_t track : some) measure_noise(detection, track);
    if (detection.smoothers.smoothers() > 0) predict(detection, some);
    if (progress) progress->step();
  });
}

// Updates the candidates until none changes. Only tracks whose candidates have changed are
// predicted again.
void iterate_candidates(Detection& detection, ShareProgress* progress) {
  std::vector<std::size_t> open(detection.measured.tracks());
  std::iota(open.begin(), open.end(), std::size_t{0});
  predict_tracks(detection, open, progress);
  for (int round = 0; round < detection.tuning.spikes.rounds && !open.empty(); ++round) {
    std::vector<std::uint8_t> changed(open.size());
    for_each_parallel(open.size(), open.size() * detection.measured.frames(), [&](std::size_t i) {
      changed[i] = update_candidates(detection, open[i]) ? 1 : 0;
    });
    std::vector<std::size_t> still_open;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (changed[i] != 0) still_open.push_back(open[i]);
    }
    open = std::move(still_open);
    predict_tracks(detection, open);
  }
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

DetectedSpikes find_spikes(VectorTracks& tracks, const SampleMarks& initial_candidates,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const SampleMarks* missing,
                           ShareProgress* progress, const TrackTuning& tuning) {
  const std::size_t frames = tracks.frames(), count = tracks.tracks();
  if (frames < 6) {
    return {SampleMarks(frames, count), std::vector<double>(count)};
  }
  const signal::LeaveOneOut smoothers(frames, frame_rate_hz, tuning.spikes.predictors);
  Detection detection{tracks,
                      frame_rate_hz,
                      missing,
                      smoothers,
                      tuning,
                      initial_candidates,
                      std::vector<std::uint8_t>(count),
                      std::vector<double>(count),
                      Predictions(frames, count)};
  start_at_dense_outliers(detection);
  iterate_candidates(detection, progress);
  std::vector<double> shares = smoothing_shares(tracks, detection.noise, frame_rate_hz, tuning);
  // A track of dense outliers is treated as noisy, however quiet the samples between them.
  for (std::size_t n = 0; n < count; ++n)
    if (detection.dense[n] != 0) shares[n] = 1;
  const SampleMarks candidates = std::exchange(
      detection.candidates,
      classify_spikes({tracks, detection.predictions, detection.candidates, detection.noise, shares,
                       detection.dense, nearby, frame_rate_hz, tuning.spikes, missing}));
  detection.predictions = Predictions(0, 0);
  for_each_parallel(count, frames * count, [&](std::size_t n) {
    const std::span<const std::uint8_t> before = candidates.track(n),
                                        now = detection.candidates.track(n);
    if (!std::equal(now.begin(), now.end(), before.begin())) measure_noise(detection, n);
    interpolate_candidates(detection, n, tracks.track(n));
  });
  return {std::move(detection.candidates), std::move(detection.noise)};
}

}  // namespace kinemend
