#include "tracks/spike_trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Between what is asked on a clean track (share 0) and on a noisy one (share 1).
double between(double clean, double noisy, double share) { return clean + (noisy - clean) * share; }

// Whether a sample goes on where the samples before it, or those behind it, are heading. Then it is
// no spike but one side of an impact, at which the motion stops or turns from one frame to the
// next.
bool continues_a_side(const SpikeTrial& trial, std::size_t t, std::size_t n) {
  constexpr double far = 3;  // standard deviations of the extrapolation
  constexpr double part_of_error = 0.3;
  const double linear_gain = std::sqrt(6.0), parabola_gain = std::sqrt(20.0);
  const double error = trial.predictions.errors(t, n);
  const double scale = far * median_of_chi3 * std::max(trial.noise[n], least_noise);
  const auto frames = static_cast<std::ptrdiff_t>(trial.accused.frames);
  for (const std::ptrdiff_t side : {-1, 1}) {
    const auto frame = [&](std::ptrdiff_t k) { return static_cast<std::ptrdiff_t>(t) + side * k; };
    const auto seen = [&](std::ptrdiff_t k) {
      const std::ptrdiff_t f = frame(k);
      return f >= 0 && f < frames && trial.accused(static_cast<std::size_t>(f), n) == 0 &&
             !trial.is_missing(static_cast<std::size_t>(f), n);
    };
    const auto at = [&](std::ptrdiff_t k) {
      return trial.measured.at(static_cast<std::size_t>(frame(k)), n);
    };
    if (!seen(1) || !seen(2)) continue;
    const double off_line = norm(at(0) - (2.0 * at(1) - at(2)));
    if (off_line < std::min(linear_gain * scale, part_of_error * error)) return true;
    if (!seen(3)) continue;
    const double off_parabola = norm(at(0) - (3.0 * at(1) - 3.0 * at(2) + at(3)));
    if (off_parabola < std::min(parabola_gain * scale, part_of_error * error)) return true;
  }
  return false;
}

// The largest prediction error about a sample, its neighbours left out. On a noisy track other
// suspects are no witnesses; on a quiet one at most one of them may be set aside.
double largest_error_about(const SpikeTrial& trial, std::size_t t, std::size_t n, bool quiet) {
  constexpr std::size_t reach = 12;
  const std::size_t first = t < reach ? 0 : t - reach,
                    last = std::min(t + reach + 1, trial.accused.frames);
  const auto close = [](std::size_t a, std::size_t b) { return (a > b ? a - b : b - a) <= 1; };
  std::vector<double> about;
  for (std::size_t k = first; k < last; ++k) {
    const bool left_out =
        close(k, t) || trial.is_missing(k, n) || (!quiet && trial.accused(k, n) != 0);
    about.push_back(left_out ? 0 : trial.predictions.errors(k, n));
  }
  if (quiet) {
    const auto aside =
        static_cast<std::size_t>(std::max_element(about.begin(), about.end()) - about.begin());
    for (std::size_t k = 0; k < about.size(); ++k) {
      if (close(k, aside)) about[k] = 0;
    }
  }
  return *std::max_element(about.begin(), about.end());
}

// A leap out of the motion and back within two frames, faster than any joint turns: the shoulder of
// a pitcher, the fastest there is, reaches about 7,500 degrees a second.
bool is_impossible(const SpikeTrial& trial, std::size_t t, std::size_t n) {
  constexpr double fastest_deg_s = 7500;
  constexpr std::size_t longest_run = 2, margin = 3;
  std::size_t first = t, last = t;
  while (first > 0 && trial.accused(first - 1, n) != 0) --first;
  while (last + 1 < trial.accused.frames && trial.accused(last + 1, n) != 0) ++last;
  if (last - first + 1 > longest_run || first < margin || last + margin >= trial.accused.frames)
    return false;
  const double error = trial.predictions.errors(t, n);
  const double gap = norm(trial.measured.at(last + 1, n) - trial.measured.at(first - 1, n));
  return error > std::clamp(fastest_deg_s / trial.frame_rate_hz, 30.0, 120.0) && gap < 0.25 * error;
}

// `share`: how noisy the track is taken to be.
bool stands_clear(const SpikeTrial& trial, std::size_t t, std::size_t n, double share) {
  const double error = trial.predictions.errors(t, n);
  const bool quiet = share < 0.5;
  if (error <= between(15, least_deviation, share)) return false;
  if (error <= between(6, 2, share) * largest_error_about(trial, t, n, quiet)) return false;
  if (continues_a_side(trial, t, n)) return false;
  if (!quiet) return true;
  // What moves several joints at once is motion.
  return std::none_of(trial.nearby[n].begin(), trial.nearby[n].end(), [&](std::size_t other) {
    return trial.predictions.errors(t, other) > error / 3 * (1 + 10 * share);
  });
}

double poisson_tail(double mean, std::size_t at_least) {
  double term = std::exp(-mean), below = 0;
  for (std::size_t k = 0; k < at_least; ++k) {
    below += term;
    term *= mean / static_cast<double>(k + 1);
  }
  return 1 - below;
}

void acquit_clusters(SampleMarks& marked) {
  constexpr std::size_t lonely = 8, usual_cluster = 3, largest_cluster = 50;
  const auto total = std::count(marked.marks.begin(), marked.marks.end(), 1);
  if (total == 0) return;
  const double rate =
      std::min(0.05, static_cast<double>(total) / static_cast<double>(marked.marks.size()));
  for (std::size_t n = 0; n < marked.tracks; ++n) {
    std::vector<std::size_t> frames;
    for (std::size_t t = 0; t < marked.frames; ++t) {
      if (marked(t, n) != 0) frames.push_back(t);
    }
    for (std::size_t first = 0; first < frames.size();) {
      std::size_t last = first;
      while (last + 1 < frames.size() && frames[last + 1] - frames[last] <= lonely) ++last;
      const double expected = rate * static_cast<double>(frames[last] - frames[first] + 2 * lonely);
      std::size_t allowed = usual_cluster;
      while (allowed < largest_cluster && poisson_tail(expected, allowed + 1) > 1e-4) ++allowed;
      if (last - first + 1 > allowed) {
        for (std::size_t i = first; i <= last; ++i) marked(frames[i], n) = 0;
      }
      first = last + 1;
    }
  }
}

// Whether what a track does at its accused samples is within reach of a body, on average.
bool could_be_motion(const SpikeTrial& trial, const SampleMarks& guilty, std::size_t n) {
  constexpr double fast_deg_s = 2000;
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < guilty.frames; ++t) {
    if (guilty(t, n) == 0) continue;
    sum += trial.predictions.errors(t, n);
    ++count;
  }
  return sum * trial.frame_rate_hz < fast_deg_s * count;
}

// The tracks with far more verdicts than chance puts there, judged by all the others, where the
// rate is so low that a joint gets there and back within two frames: a toe that leaves the ground
// does so at every step. That is a habit, not damage.
std::vector<std::uint8_t> find_habits(const SpikeTrial& trial, const SampleMarks& guilty) {
  constexpr double high_rate_hz = 100, chance = 1e-4;
  constexpr std::size_t fewest_verdicts = 4, fewest_tracks = 4;
  std::vector<std::uint8_t> habits(guilty.tracks);
  if (trial.frame_rate_hz >= high_rate_hz || guilty.tracks < fewest_tracks) return habits;
  std::vector<std::size_t> verdicts(guilty.tracks);
  std::size_t total = 0;
  for (std::size_t i = 0; i < guilty.marks.size(); ++i) {
    verdicts[i / guilty.frames] += guilty.marks[i];
    total += guilty.marks[i];
  }
  for (std::size_t others = guilty.tracks - 1; others > 0; --others) {
    const auto worst = std::max_element(verdicts.begin(), verdicts.end());
    const auto n = static_cast<std::size_t>(worst - verdicts.begin());
    const double expected = static_cast<double>(total - *worst) / static_cast<double>(others);
    if (*worst < fewest_verdicts || poisson_tail(expected, *worst) > chance) break;
    habits[n] = could_be_motion(trial, guilty, n);
    total -= *worst;
    *worst = 0;
  }
  return habits;
}

// Of a track with a habit only what goes far beyond it stays marked.
void acquit_habit(const SpikeTrial& trial, std::size_t n, SampleMarks& guilty) {
  constexpr double beyond = 2;
  std::vector<double> errors;
  for (std::size_t t = 0; t < guilty.frames; ++t) {
    if (guilty(t, n) != 0) errors.push_back(trial.predictions.errors(t, n));
  }
  if (errors.empty()) return;
  const double middle = upper_median_of(errors);
  for (std::size_t t = 0; t < guilty.frames; ++t) {
    guilty(t, n) = guilty(t, n) != 0 && trial.predictions.errors(t, n) > beyond * middle;
  }
}

// What damage of a take does at least, told by the spikes that are surely there: where these are
// much alike in size, what is far smaller is the take's own, as a toe that snaps is. Where their
// sizes differ widely nothing is too small.
double least_damage(const SpikeTrial& trial, const SampleMarks& sure) {
  constexpr double low = 0.1, reach = 3, most = 0.4;
  std::vector<double> sizes;
  for (std::size_t n = 0; n < sure.tracks; ++n) {
    if (trial.shares[n] >= 1) continue;
    for (std::size_t t = 0; t < sure.frames; ++t) {
      if (sure(t, n) != 0) sizes.push_back(trial.predictions.errors(t, n));
    }
  }
  if (sizes.empty()) return 0;
  const double usual = quantile_of(sizes, 0.5);
  return std::min(most * usual, usual - reach * (usual - quantile_of(sizes, low)));
}

}  // namespace

SampleMarks judge_spikes(const SpikeTrial& trial) {
  const SampleMarks& accused = trial.accused;
  SampleMarks guilty(accused.frames, accused.tracks);
  std::size_t quiet_samples = 0, quiet_verdicts = 0;
  const auto judge_track = [&](std::size_t n, double share) {
    for (std::size_t t = 0; t < accused.frames; ++t) {
      guilty(t, n) = accused(t, n) != 0 && stands_clear(trial, t, n, share);
    }
  };
  const auto keep_impossible = [&](std::size_t n) {
    for (std::size_t t = 0; t < accused.frames; ++t) {
      if (guilty(t, n) != 0) guilty(t, n) = is_impossible(trial, t, n);
    }
  };
  for (std::size_t n = 0; n < accused.tracks; ++n) judge_track(n, trial.shares[n]);
  const std::vector<std::uint8_t> habits = find_habits(trial, guilty);
  for (std::size_t n = 0; n < accused.tracks; ++n) {
    if (habits[n] != 0) acquit_habit(trial, n, guilty);
    if (trial.shares[n] >= 1) continue;
    quiet_samples += accused.frames;
    for (std::size_t t = 0; t < accused.frames; ++t) quiet_verdicts += guilty(t, n);
  }
  // A few odd samples in a quiet take are its own, and only what is impossible is repaired. Many
  // are damage: then the quiet tracks are judged again, as strictly as the noisy ones, but for what
  // is too small for that damage.
  const double damage = std::max(5.0, 0.0006 * static_cast<double>(quiet_samples));
  const bool damaged = static_cast<double>(quiet_verdicts) >= damage;
  const double least = damaged ? least_damage(trial, guilty) : 0;
  for (std::size_t n = 0; n < accused.tracks; ++n) {
    if (habits[n] != 0 || trial.shares[n] >= 1) continue;
    if (damaged) {
      judge_track(n, 1);
      for (std::size_t t = 0; t < accused.frames; ++t) {
        if (trial.predictions.errors(t, n) < least) guilty(t, n) = 0;
      }
    } else {
      keep_impossible(n);
    }
  }
  const std::vector<std::uint8_t> late_habits = find_habits(trial, guilty);
  for (std::size_t n = 0; n < accused.tracks; ++n) {
    if (late_habits[n] != 0) acquit_habit(trial, n, guilty);
  }
  acquit_clusters(guilty);
  return guilty;
}

}  // namespace kinemend
