// Classifies candidates by their neighbours, the speed of joints, and chance.
#include "methods/auto/spike_classification.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Interpolates a threshold between quiet tracks (share 0) and noisy ones (share 1).
double between(double quiet, double noisy, double share) { return quiet + (noisy - quiet) * share; }

// Whether a sample agrees with the extrapolation of the samples before it or of those after it. It
// then is one side of an impact, at which velocity changes from one frame to the next.
bool continues_one_side(const SpikeCandidates& candidates, std::size_t t, std::size_t n) {
  const double most = candidates.tuning.side_error_share * candidates.predictions.errors(t, n);
  const auto frames = static_cast<std::ptrdiff_t>(candidates.marks.frames);
  for (const std::ptrdiff_t side : {-1, 1}) {
    const auto frame = [&](std::ptrdiff_t k) { return static_cast<std::ptrdiff_t>(t) + side * k; };
    const auto seen = [&](std::ptrdiff_t k) {
      const std::ptrdiff_t f = frame(k);
      return f >= 0 && f < frames && candidates.marks(static_cast<std::size_t>(f), n) == 0 &&
             !candidates.is_missing(static_cast<std::size_t>(f), n);
    };
    const auto at = [&](std::ptrdiff_t k) {
      return candidates.measured.at(static_cast<std::size_t>(frame(k)), n);
    };
    if (!seen(1) || !seen(2)) continue;
    if (norm(at(0) - (2.0 * at(1) - at(2))) < most) return true;
    if (seen(3) && norm(at(0) - (3.0 * at(1) - 3.0 * at(2) + at(3))) < most) return true;
  }
  return false;
}

// The largest prediction error about a sample, its neighbours left out. On a noisy track other
// candidates are ignored; on a quiet one the largest error and its neighbours are.
double largest_error_about(const SpikeCandidates& candidates, std::size_t t, std::size_t n,
                           bool quiet) {
  const std::size_t reach = candidates.tuning.surrounding_frames;
  const std::size_t first = t < reach ? 0 : t - reach,
                    last = std::min(t + reach + 1, candidates.marks.frames);
  const auto close = [](std::size_t a, std::size_t b) { return (a > b ? a - b : b - a) <= 1; };
  std::vector<double> about;
  for (std::size_t k = first; k < last; ++k) {
    const bool left_out =
        close(k, t) || candidates.is_missing(k, n) || (!quiet && candidates.marks(k, n) != 0);
    about.push_back(left_out ? 0 : candidates.predictions.errors(k, n));
  }
  if (quiet) {
    const auto largest =
        static_cast<std::size_t>(std::max_element(about.begin(), about.end()) - about.begin());
    for (std::size_t k = 0; k < about.size(); ++k) {
      if (close(k, largest)) about[k] = 0;
    }
  }
  return *std::max_element(about.begin(), about.end());
}

// Whether a run of at most two candidates leaves the motion and returns faster than a joint turns:
// the fastest known rotation, a pitcher's shoulder, reaches about 7,500 degrees a second.
bool exceeds_joint_speed(const SpikeCandidates& candidates, std::size_t t, std::size_t n) {
  const SpikeTuning& tuning = candidates.tuning;
  std::size_t first = t, last = t;
  while (first > 0 && candidates.marks(first - 1, n) != 0) --first;
  while (last + 1 < candidates.marks.frames && candidates.marks(last + 1, n) != 0) ++last;
  if (last - first + 1 > tuning.longest_run || first == 0 || last + 1 == candidates.marks.frames)
    return false;
  const double error = candidates.predictions.errors(t, n);
  const double gap =
      norm(candidates.measured.at(last + 1, n) - candidates.measured.at(first - 1, n));
  return error * candidates.frame_rate_hz > tuning.fastest_deg_s &&
         gap < tuning.return_share * error;
}

// `share`: 0 applies the thresholds of quiet tracks, 1 those of noisy ones.
bool is_isolated(const SpikeCandidates& candidates, std::size_t t, std::size_t n, double share) {
  const SpikeTuning& tuning = candidates.tuning;
  const double error = candidates.predictions.errors(t, n);
  const bool quiet = share < 0.5;
  const double clearance = between(tuning.clearance_quiet, tuning.clearance_noisy, share);
  // Among dense outliers the largest error is useless: it may be another outlier.
  if (candidates.dense[n] == 0 && error <= clearance * largest_error_about(candidates, t, n, quiet))
    return false;
  if (continues_one_side(candidates, t, n)) return false;
  if (!quiet) return true;
  // An error that several joints share is motion.
  return std::none_of(
      candidates.nearby[n].begin(), candidates.nearby[n].end(), [&](std::size_t other) {
        return candidates.predictions.errors(t, other) > error / tuning.nearby_ratio;
      });
}

// Probability of at least `at_least` events where `mean` are expected: the sum of Poisson's terms,
// from the largest on. Returns 1 for at most the mean.
double poisson_tail(double mean, std::size_t at_least) {
  const auto count = static_cast<double>(at_least);
  if (count <= mean) return 1;
  if (mean <= 0) return 0;
  double term = portable::exp(count * portable::log(mean) - mean - portable::lgamma(count + 1)),
         sum = 0;
  for (double k = count; term > 1e-9 * sum; term *= mean / ++k) sum += term;
  return sum;
}

// Rejects runs of spikes, at most `cluster_gap` frames apart, that are longer than Poisson chance
// explains at the take's rate of spikes, or at that of a track of dense outliers.
void reject_clusters(const SpikeCandidates& candidates, SampleMarks& marked) {
  const SpikeTuning& tuning = candidates.tuning;
  const auto total = std::count(marked.marks.begin(), marked.marks.end(), 1);
  if (total == 0) return;
  const double rate_of_take = static_cast<double>(total) / static_cast<double>(marked.marks.size());
  for (std::size_t n = 0; n < marked.tracks; ++n) {
    std::vector<std::size_t> frames;
    for (std::size_t t = 0; t < marked.frames; ++t) {
      if (marked(t, n) != 0) frames.push_back(t);
    }
    const double own = static_cast<double>(frames.size()) / static_cast<double>(marked.frames);
    const double rate = candidates.dense[n] != 0 ? std::max(own, rate_of_take) : rate_of_take;
    for (std::size_t first = 0; first < frames.size();) {
      std::size_t last = first;
      while (last + 1 < frames.size() && frames[last + 1] - frames[last] <= tuning.cluster_gap)
        ++last;
      const double expected =
          rate * static_cast<double>(frames[last] - frames[first] + 2 * tuning.cluster_gap);
      const std::size_t count = last - first + 1;
      if (count > tuning.usual_cluster && poisson_tail(expected, count) <= tuning.chance) {
        for (std::size_t i = first; i <= last; ++i) marked(frames[i], n) = 0;
      }
      first = last + 1;
    }
  }
}

// On tracks of dense outliers, keeps only those spikes of a long run (longer than chance explains)
// that are far from the samples beside them: the others are a move that is too quick to be
// predicted.
void reject_quick_moves(const SpikeCandidates& candidates, SampleMarks& marked) {
  const SpikeTuning& tuning = candidates.tuning;
  const std::size_t frames = marked.frames;
  for (std::size_t n = 0; n < marked.tracks; ++n) {
    if (candidates.dense[n] == 0) continue;
    const auto track = marked.track(n);
    const std::vector<std::uint8_t> before(track.begin(), track.end());
    const double share = static_cast<double>(std::count(before.begin(), before.end(), 1)) /
                         static_cast<double>(frames);
    const auto agrees = [&](std::size_t t, std::size_t other) {
      return norm(candidates.measured.at(t, n) - candidates.measured.at(other, n)) <
             tuning.move_share * candidates.predictions.errors(t, n);
    };
    for (std::size_t first = 0; first < frames;) {
      std::size_t last = first;
      while (last < frames && before[last] != 0) ++last;
      const auto length = static_cast<double>(last - first);
      if (last > first &&
          static_cast<double>(frames) * portable::pow(share, length) < tuning.chance) {
        for (std::size_t t = first; t < last; ++t) {
          if ((t > 0 && agrees(t, t - 1)) || (t + 1 < frames && agrees(t, t + 1))) track[t] = 0;
        }
      }
      first = last + 1;
    }
  }
}

// Whether the mean speed of a track's spikes is within that of joints.
bool is_within_joint_speed(const SpikeCandidates& candidates, const SampleMarks& spikes,
                           std::size_t n) {
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < spikes.frames; ++t) {
    if (spikes(t, n) == 0) continue;
    sum += candidates.predictions.errors(t, n);
    ++count;
  }
  return sum * candidates.frame_rate_hz < candidates.tuning.recurrent_deg_s * count;
}

// Tracks with more spikes than Poisson chance explains at the mean rate of the other tracks with
// one spike more, where tracks with even more are left out. Such recurrent spikes are motion, for
// example of a toe that leaves the ground at every step.
std::vector<std::uint8_t> find_recurrent(const SpikeCandidates& candidates,
                                         const SampleMarks& spikes) {
  const SpikeTuning& tuning = candidates.tuning;
  std::vector<std::uint8_t> recurrent(spikes.tracks);
  std::vector<std::size_t> counts(spikes.tracks);
  std::size_t total = 0;
  for (std::size_t i = 0; i < spikes.marks.size(); ++i) {
    counts[i / spikes.frames] += spikes.marks[i];
    total += spikes.marks[i];
  }
  for (std::size_t left = spikes.tracks; left > 0; --left) {
    const auto worst = std::max_element(counts.begin(), counts.end());
    const auto n = static_cast<std::size_t>(worst - counts.begin());
    const double expected = static_cast<double>(total - *worst + 1) / static_cast<double>(left);
    if (poisson_tail(expected, *worst) > tuning.chance) break;
    recurrent[n] = is_within_joint_speed(candidates, spikes, n);
    total -= *worst;
    *worst = 0;
  }
  return recurrent;
}

void reject_track(std::size_t n, SampleMarks& spikes) {
  const auto track = spikes.track(n);
  std::fill(track.begin(), track.end(), std::uint8_t{0});
}

// The smallest error of a spike in a damaged take, from the spikes of the strict thresholds: a much
// smaller error is motion, for example of a fast toe.
double smallest_spike(const SpikeCandidates& candidates, const SampleMarks& sure) {
  const SpikeTuning& tuning = candidates.tuning;
  std::vector<double> sizes;
  for (std::size_t n = 0; n < sure.tracks; ++n) {
    if (candidates.shares[n] >= 1 && candidates.dense[n] == 0) continue;
    for (std::size_t t = 0; t < sure.frames; ++t) {
      if (sure(t, n) != 0) sizes.push_back(candidates.predictions.errors(t, n));
    }
  }
  return sizes.empty() ? 0 : tuning.smallest_share * quantile_of(sizes, tuning.low_quantile);
}

}  // namespace

SampleMarks classify_spikes(const SpikeCandidates& candidates) {
  const SpikeTuning& tuning = candidates.tuning;
  const SampleMarks& marks = candidates.marks;
  SampleMarks spikes(marks.frames, marks.tracks);
  std::size_t quiet_samples = 0, quiet_spikes = 0;
  const bool brief = is_brief(marks.frames, candidates.frame_rate_hz);
  const auto classify_track = [&](std::size_t n, double share) {
    for (std::size_t t = 0; t < marks.frames; ++t) {
      spikes(t, n) = marks(t, n) != 0 && is_isolated(candidates, t, n, share);
    }
  };
  const auto keep_too_fast = [&](std::size_t n) {
    for (std::size_t t = 0; t < marks.frames; ++t) {
      if (spikes(t, n) != 0) spikes(t, n) = exceeds_joint_speed(candidates, t, n);
    }
  };
  for (std::size_t n = 0; n < marks.tracks; ++n) classify_track(n, candidates.shares[n]);
  const std::vector<std::uint8_t> recurrent = find_recurrent(candidates, spikes);
  for (std::size_t n = 0; n < marks.tracks; ++n) {
    if (recurrent[n] != 0) reject_track(n, spikes);
    if (candidates.shares[n] >= 1 && candidates.dense[n] == 0) continue;
    quiet_samples += marks.frames;
    const auto track = spikes.track(n);
    const auto own = static_cast<std::size_t>(std::count(track.begin(), track.end(), 1));
    // Damage affects many tracks; a few pops of one track are a move if moves are as quick.
    quiet_spikes += brief ? std::min<std::size_t>(own, 1) : own;
  }
  // Few spikes in a quiet take are motion unless they exceed the speed of joints. Many are damage:
  // quiet tracks then get the thresholds of noisy ones, and a smallest error.
  const double damage =
      std::max(tuning.damage_count, tuning.damage_share * static_cast<double>(quiet_samples));
  const bool damaged = static_cast<double>(quiet_spikes) >= damage;
  const double least = damaged ? smallest_spike(candidates, spikes) : 0;
  for (std::size_t n = 0; n < marks.tracks; ++n) {
    if (recurrent[n] != 0 || candidates.shares[n] >= 1) continue;
    if (damaged) {
      classify_track(n, 1);
      for (std::size_t t = 0; t < marks.frames; ++t) {
        if (candidates.predictions.errors(t, n) < least) spikes(t, n) = 0;
      }
    } else {
      keep_too_fast(n);
    }
  }
  const std::vector<std::uint8_t> late_recurrent = find_recurrent(candidates, spikes);
  for (std::size_t n = 0; n < marks.tracks; ++n) {
    if (late_recurrent[n] != 0) reject_track(n, spikes);
  }
  reject_clusters(candidates, spikes);
  reject_quick_moves(candidates, spikes);
  return spikes;
}

}  // namespace kinemend
