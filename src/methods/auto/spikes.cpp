// Predicts each sample from the others of its track, and repeats this without the candidates until
// they no longer change. Finds dense outliers by a curve that most samples agree with.
#include "methods/auto/spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/frames.hpp"
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

namespace {

double square(double x) { return x * x; }

// The frames [first, last) of a window about a frame. Windows at the ends of the take are as long
// as the others, so that outliers are not the majority of a short one.
struct Window {
  std::size_t first, last;
};

Window window_about(std::size_t t, std::size_t reach, std::size_t frames) {
  const std::size_t length = std::min(2 * reach + 1, frames);
  const std::size_t first = std::min(t - std::min(t, reach), frames - length);
  return {first, first + length};
}

// One track with its settings and intermediate results.
class RobustCurve {
 public:
  RobustCurve(std::span<const Vec3> track, std::span<const std::uint8_t> missing,
              double frame_rate_hz, const DenseTuning& tuning)
      : track_(track), missing_(missing), tuning_(tuning), errors_(track.size()) {
    const double rate_hz = window_rate_hz(frame_rate_hz);
    wide_reach_ = frames_of(tuning.wide_half_s, rate_hz);
    reach_ = frames_of(tuning.curve_half_s, rate_hz);
    scale_reach_ = frames_of(tuning.scale_half_s, rate_hz);
  }

  void fit() {
    start_by_medians();
    std::vector<double> weights(track_.size());
    // A wide window holds more samples than a cluster of outliers; a narrow one follows the motion.
    for (int round = 0; round < 2 * tuning_.rounds; ++round) {
      const std::size_t reach = round < tuning_.rounds ? wide_reach_ : reach_;
      for (std::size_t t = 0; t < track_.size(); ++t) {
        const double welsch = tuning_.welsch_deviations * scale_about(t);
        weights[t] = is_missing(t) ? 0 : portable::exp(-0.5 * square(norm(errors_[t]) / welsch));
      }
      for (std::size_t t = 0; t < track_.size(); ++t)
        errors_[t] = track_[t] - value_at(t, reach, weights);
    }
  }

  // Whether a sample is far from the curve and agrees with neither neighbour. Samples of a motion
  // too quick for the curve share a deviation; those beside a step share a value.
  bool is_outlier(std::size_t t) {
    const double error = norm(errors_[t]);
    if (is_missing(t) || error <= tuning_.least_error) return false;
    if (error <= tuning_.ratio * scale_about(t)) return false;
    const auto agrees = [&](std::size_t other) {
      const double apart =
          std::min(norm(errors_[t] - errors_[other]), norm(track_[t] - track_[other]));
      return apart < tuning_.least_apart * error;
    };
    return !(t > 0 && agrees(t - 1)) && !(t + 1 < track_.size() && agrees(t + 1));
  }

 private:
  static std::size_t frames_of(double seconds, double rate_hz) {
    // Minimum of frames on a side: a quadratic has three unknowns, and with fewer samples it can
    // fit most samples of a shake.
    constexpr std::size_t fewest = 5;
    return std::max<std::size_t>(fewest, static_cast<std::size_t>(std::lround(seconds * rate_hz)));
  }

  bool is_missing(std::size_t t) const { return !missing_.empty() && missing_[t] != 0; }

  void start_by_medians() {
    std::vector<double> x, y, z;
    for (std::size_t t = 0; t < track_.size(); ++t) {
      const Window window = window_about(t, wide_reach_, track_.size());
      x.clear();
      y.clear();
      z.clear();
      for (std::size_t k = window.first; k < window.last; ++k) {
        if (is_missing(k)) continue;
        x.push_back(track_[k].x);
        y.push_back(track_[k].y);
        z.push_back(track_[k].z);
      }
      errors_[t] = x.empty() ? Vec3{} : track_[t] - Vec3{median_of(x), median_of(y), median_of(z)};
    }
  }

  // Deviation per axis of the samples about this one that lie close to the curve, by their median.
  double scale_about(std::size_t t) {
    const Window window = window_about(t, scale_reach_, track_.size());
    sizes_.clear();
    for (std::size_t k = window.first; k < window.last; ++k)
      if (!is_missing(k)) sizes_.push_back(norm(errors_[k]));
    const double scale = sizes_.empty() ? 0 : median_of(sizes_) / median_of_chi3;
    return std::max(scale, tuning_.least_scale);
  }

  // Value at frame t of the quadratic through the samples about it.
  Vec3 value_at(std::size_t t, std::size_t reach, const std::vector<double>& weights) const {
    // A minimal weight of every sample keeps the system solvable if all are far from the curve.
    constexpr double trace = 1e-6;
    std::array<double, 5> moments{};
    std::array<Vec3, 3> products{};
    const Window window = window_about(t, reach, track_.size());
    const auto half = static_cast<double>(std::max(t - window.first, window.last - t - 1) + 1);
    for (std::size_t k = window.first; k < window.last; ++k) {
      if (is_missing(k)) continue;
      const double x = (static_cast<double>(k) - static_cast<double>(t)) / half;
      const double tricube = 1 - std::abs(x * x * x);
      double power = tricube * tricube * tricube * (weights[k] + trace);
      for (std::size_t i = 0; i < 5; ++i, power *= x) {
        moments[i] += power;
        if (i < 3) products[i] += power * track_[k];
      }
    }
    return value_of(moments, products, track_[t] - errors_[t]);
  }

  // The constant term of the quadratic with these sums, by Cramer's rule; that of the line or the
  // mean if the samples do not determine a quadratic, `otherwise` without samples.
  static Vec3 value_of(const std::array<double, 5>& m, const std::array<Vec3, 3>& p,
                       Vec3 otherwise) {
    constexpr double singular = 1e-9;
    if (m[0] <= 0) return otherwise;
    const double a = m[2] * m[4] - m[3] * m[3], b = m[2] * m[3] - m[1] * m[4],
                 c = m[1] * m[3] - m[2] * m[2];
    const double all = m[0] * a + m[1] * b + m[2] * c;
    if (all > singular * m[0] * m[0] * m[0]) return (1 / all) * (a * p[0] + b * p[1] + c * p[2]);
    const double line = m[0] * m[2] - m[1] * m[1];
    if (line > singular * m[0] * m[0]) return (1 / line) * (m[2] * p[0] - m[1] * p[1]);
    return (1 / m[0]) * p[0];
  }

  std::span<const Vec3> track_;
  std::span<const std::uint8_t> missing_;
  const DenseTuning& tuning_;
  std::vector<Vec3> errors_;  // each sample's distance from the curve
  std::size_t wide_reach_ = 0, reach_ = 0, scale_reach_ = 0;
  std::vector<double> sizes_;
};

// Whether many samples are far from the mean of their neighbours. Tracks without outliers thus need
// no fit.
bool may_be_dense(std::span<const Vec3> track, std::span<const std::uint8_t> missing,
                  const DenseTuning& tuning) {
  std::size_t far = 0, seen = 0;
  const auto is_seen = [&](std::size_t t) { return missing.empty() || missing[t] == 0; };
  for (std::size_t t = 1; t + 1 < track.size(); ++t) {
    if (!is_seen(t - 1) || !is_seen(t) || !is_seen(t + 1)) continue;
    ++seen;
    far += norm(track[t] - 0.5 * (track[t - 1] + track[t + 1])) > tuning.least_error;
  }
  return static_cast<double>(far) > tuning.least_share * static_cast<double>(seen);
}

}  // namespace

std::vector<std::uint8_t> dense_outliers(std::span<const Vec3> track,
                                         std::span<const std::uint8_t> missing,
                                         double frame_rate_hz, const DenseTuning& tuning) {
  if (track.size() < 2 * tuning.fewest_outliers || !may_be_dense(track, missing, tuning)) return {};
  RobustCurve curve(track, missing, frame_rate_hz, tuning);
  curve.fit();
  std::vector<std::uint8_t> marks(track.size());
  std::size_t seen = 0, outliers = 0;
  for (std::size_t t = 0; t < track.size(); ++t) {
    seen += missing.empty() || missing[t] == 0;
    marks[t] = curve.is_outlier(t) ? 1 : 0;
    outliers += marks[t];
  }
  if (outliers < tuning.fewest_outliers) return {};
  if (static_cast<double>(outliers) <= tuning.least_share * static_cast<double>(seen)) return {};
  return marks;
}

}  // namespace kinemend
