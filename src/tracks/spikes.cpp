#include "tracks/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "kinemend/frame_rate.hpp"
#include "signal/leave_one_out.hpp"
#include "tracks/spike_trial.hpp"

namespace kinemend {

namespace {

constexpr double accused_ratio = 6.5;  // prediction error over its standard deviation
constexpr double robust_cap = 6;  // errors count for no more than this many standard deviations
constexpr int rounds = 5;

// What is known of the samples while rounds of accusation go on, each track for itself.
struct Inquest {
  const VectorTracks& measured;
  double frame_rate_hz;
  const SampleMarks* missing;
  const signal::LeaveOneOut& others;
  SampleMarks accused;
  std::vector<double> noise;  // without the accused
  Predictions predictions;

  std::vector<std::uint8_t> left_out(std::size_t track) const {
    const auto marks = accused.track(track);
    std::vector<std::uint8_t> result(marks.begin(), marks.end());
    for (std::size_t t = 0; missing && t < result.size(); ++t) result[t] |= (*missing)(t, track);
    return result;
  }
};

// The accused, and the gaps whose bridges rest on one of them.
std::vector<std::uint8_t> with_bridges_beside(std::span<const std::uint8_t> accused,
                                              std::span<const std::uint8_t> missing) {
  std::vector<std::uint8_t> result(accused.begin(), accused.end());
  const std::size_t frames = accused.size();
  for (std::size_t t = 0; t < frames;) {
    if (missing[t] == 0) {
      ++t;
      continue;
    }
    const std::size_t first = t;
    while (t < frames && missing[t] != 0) ++t;
    const bool rests_on_accused =
        (first > 0 && accused[first - 1] != 0) || (t < frames && accused[t] != 0);
    for (std::size_t f = first; rests_on_accused && f < t; ++f) result[f] = 1;
  }
  return result;
}

// Puts lines through the accused of a track, and through bridges that rest on one.
void refill(const Inquest& inquest, std::size_t track, std::span<Vec3> filled) {
  const auto accused = inquest.accused.track(track);
  if (inquest.missing) {
    fill_marked(filled, with_bridges_beside(accused, inquest.missing->track(track)));
  } else {
    fill_marked(filled, accused);
  }
}

void measure_noise(Inquest& inquest, std::size_t track) {
  inquest.noise[track] = noise_level(inquest.measured.track(track), inquest.left_out(track),
                                     inquest.measured.has_quiet_axes[track] != 0);
}

double error_scale(const Inquest& inquest, std::size_t track) {
  return std::max(inquest.noise[track], least_noise);
}

// The tracks, the accused interpolated.
signal::LaneBlock gather_tracks(const Inquest& inquest, std::span<const std::size_t> tracks) {
  signal::LaneBlock block(inquest.measured.frames());
  std::vector<Vec3> filled;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto measured = inquest.measured.track(tracks[i]);
    filled.assign(measured.begin(), measured.end());
    refill(inquest, tracks[i], filled);
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

// Predicts up to eight tracks by the smoother that suits each. A marked sample's fit is its
// prediction.
void predict(Inquest& inquest, std::span<const std::size_t> tracks) {
  const signal::LaneBlock y = gather_tracks(inquest, tracks);
  signal::BlockRow caps{};
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const double cap = robust_cap * error_scale(inquest, tracks[i]);
    caps[i] = cap * cap;
  }
  const auto best = inquest.others.best_smoothers(y, caps);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    inquest.predictions.smoothers[tracks[i]] = best[i];
  for (std::size_t smoother = 0; smoother < inquest.others.smoothers(); ++smoother) {
    const auto last = best.begin() + static_cast<std::ptrdiff_t>(tracks.size());
    if (std::find(best.begin(), last, smoother) == last) continue;
    const std::vector<double>& weight = inquest.others.weights_of_others(smoother);
    inquest.others.fit(smoother, y, [&](std::size_t first, std::size_t count, const double* x) {
      for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (best[i] != smoother) continue;
        const std::size_t n = tracks[i];
        for (std::size_t k = 0; k < count; ++k) {
          const std::size_t t = first + k;
          const Vec3 fit = lane_vector(x + k * signal::lane_row, i);
          const Vec3 given = lane_vector(y.row(t), i);
          const Vec3 predicted =
              inquest.accused(t, n) != 0 ? fit : given - (1 / weight[t]) * (given - fit);
          inquest.predictions.errors(t, n) = norm(inquest.measured.at(t, n) - predicted);
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

// A track's next suspects: of those accused before, whoever still does not fit; of the others, the
// worst within two frames. Whether they are others than before.
bool accuse(Inquest& inquest, std::size_t n) {
  const std::size_t frames = inquest.accused.frames;
  const std::span<std::uint8_t> accused = inquest.accused.track(n);
  if (inquest.others.smoothers() == 0) {
    const bool any = std::find(accused.begin(), accused.end(), 1) != accused.end();
    std::fill(accused.begin(), accused.end(), std::uint8_t{0});
    return any;
  }
  const auto half =
      static_cast<std::size_t>(std::lround(0.08 * window_rate_hz(inquest.frame_rate_hz)));
  const double scale = error_scale(inquest, n);
  const std::vector<double>& weight =
      inquest.others.weights_of_others(inquest.predictions.smoothers[n]);
  std::vector<double> ratio(frames), unaccused(frames), window;
  for (std::size_t t = 0; t < frames; ++t) {
    ratio[t] = inquest.predictions.errors(t, n) * std::sqrt(weight[t]) / scale;
    unaccused[t] = accused[t] != 0 ? 0 : ratio[t];
  }
  std::vector<std::uint8_t> next(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    if (ratio[t] <= accused_ratio || inquest.predictions.errors(t, n) <= least_deviation) continue;
    if (inquest.missing && (*inquest.missing)(t, n) != 0) continue;
    const double usual = median_about(unaccused, t, half, window);
    if (ratio[t] <= accused_ratio * std::max(1.0, usual / median_of_chi3)) continue;
    const std::size_t first = t < 2 ? 0 : t - 2, last = std::min(t + 3, frames);
    const auto from = unaccused.begin();
    const double worst = *std::max_element(from + static_cast<std::ptrdiff_t>(first),
                                           from + static_cast<std::ptrdiff_t>(last));
    next[t] = accused[t] != 0 || unaccused[t] >= worst;
  }
  if (std::equal(next.begin(), next.end(), accused.begin())) return false;
  std::copy(next.begin(), next.end(), accused.begin());
  return true;
}

// Measures and predicts these tracks, eight at a time.
void examine(Inquest& inquest, std::span<const std::size_t> tracks,
             ShareProgress* progress = nullptr) {
  const std::size_t blocks = (tracks.size() + signal::lane_tracks - 1) / signal::lane_tracks;
  if (progress) progress->begin_part(0.4, blocks);
  for_each_parallel(blocks, tracks.size() * inquest.measured.frames(), [&](std::size_t b) {
    const std::size_t first = b * signal::lane_tracks;
    const auto some = tracks.subspan(first, std::min(signal::lane_tracks, tracks.size() - first));
    for (const std::size_t track : some) measure_noise(inquest, track);
    if (inquest.others.smoothers() > 0) predict(inquest, some);
    if (progress) progress->step();
  });
}

// Accuses until nothing changes. What a track's verdicts are depends on it alone, so only those
// whose accused have changed are looked at again.
void run_rounds(Inquest& inquest, ShareProgress* progress) {
  std::vector<std::size_t> open(inquest.measured.tracks());
  std::iota(open.begin(), open.end(), std::size_t{0});
  examine(inquest, open, progress);
  for (int round = 0; round < rounds && !open.empty(); ++round) {
    std::vector<std::uint8_t> changed(open.size());
    for_each_parallel(open.size(), open.size() * inquest.measured.frames(),
                      [&](std::size_t i) { changed[i] = accuse(inquest, open[i]) ? 1 : 0; });
    std::vector<std::size_t> still_open;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (changed[i] != 0) still_open.push_back(open[i]);
    }
    open = std::move(still_open);
    examine(inquest, open);
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

SpikeVerdicts find_spikes(VectorTracks& tracks, const SampleMarks& suspects,
                          const std::vector<std::vector<std::size_t>>& nearby, double frame_rate_hz,
                          const SampleMarks* missing, ShareProgress* progress) {
  const std::size_t frames = tracks.frames(), count = tracks.tracks();
  if (frames < 6) {
    return {SampleMarks(frames, count), std::vector<double>(count)};
  }
  const signal::LeaveOneOut others(frames, frame_rate_hz);
  Inquest inquest{tracks,
                  frame_rate_hz,
                  missing,
                  others,
                  suspects,
                  std::vector<double>(count),
                  Predictions(frames, count)};
  run_rounds(inquest, progress);
  const std::vector<double> shares = cleaning_shares(inquest.noise, frame_rate_hz);
  const SampleMarks accused = std::exchange(
      inquest.accused, judge_spikes({tracks, inquest.predictions, inquest.accused, inquest.noise,
                                     shares, nearby, frame_rate_hz, missing}));
  inquest.predictions = Predictions(0, 0);
  for_each_parallel(count, frames * count, [&](std::size_t n) {
    const std::span<const std::uint8_t> before = accused.track(n), now = inquest.accused.track(n);
    if (!std::equal(now.begin(), now.end(), before.begin())) measure_noise(inquest, n);
    refill(inquest, n, tracks.track(n));
  });
  return {std::move(inquest.accused), std::move(inquest.noise)};
}

}  // namespace kinemend
