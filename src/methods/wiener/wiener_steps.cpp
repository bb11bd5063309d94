// Estimates the risk of the filter with a probe and mixes it with smoothers for each track. Finds
// dense outliers by filtering repeatedly.
#include "methods/wiener/wiener_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/signal.hpp"
#include "methods/auto/smoothing.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// Widths of the Gaussians that the guard tries, each about 4/3 of the one before.
// docs/details/wiener.md states what the guard and `clearly` bring (rows `guard`); the
// values are chosen by hand, not swept.
constexpr std::array<double, 14> widths_s = {0.006, 0.008, 0.011, 0.014, 0.018, 0.024, 0.032,
                                             0.042, 0.055, 0.075, 0.1,   0.14,  0.19,  0.25};
constexpr double probe_share = 0.1;      // of the noise
constexpr double clearly = 0.95;         // of the filter's risk
constexpr double fewest_counted = 0.8;   // share of samples
constexpr std::uint64_t probe_seed = 7;  // any seed works

// Chosen by hand, not swept.
constexpr double most_of_typical = 25;         // a single difference, of the typical variance
constexpr double least_guard_variance = 1e-6;  // square degrees
constexpr double gap_fade_s =
    0.1;  // as far as `auto` can tell: white noise, and no repeated frames

// A filtered take, and D: the mean of d x_t / d y_t.
struct Estimate {
  PoseMatrix poses;
  std::vector<double> divergence;
};

// The weight of a sample in its own mean.
double centre_weight(double sigma_frames) {
  double sum = 1;
  for (int j = 1; j < 4 * sigma_frames + 1; ++j)
    sum += 2 * portable::exp(-0.5 * (j / sigma_frames) * (j / sigma_frames));
  return 1 / sum;
}

// Smooths channels in place as `auto` smooths tracks, each three of them one track, without a
// learned model. `missing` is F x D, 1 for samples without weight; `noise` D, standard deviations,
// degrees, all above 0. Tracks of fewer than 16 frames are not changed.
void smooth_channels(PoseMatrix& poses, std::span<const std::uint8_t> missing,
                     std::span<const double> noise, double frame_rate_hz) {
  // Chosen by hand, not swept.
  constexpr std::size_t fewest_smoothed_frames = 16;  // fewer do not determine a strength
  // Channels are scaled to the same noise, which is then isotropic.
  VectorTracks tracks(poses.frames, poses.channels / 3, [&](std::size_t f, std::size_t n) {
    const Vec3 v = vector_at(poses, f, n);
    return Vec3{v.x / noise[3 * n], v.y / noise[3 * n + 1], v.z / noise[3 * n + 2]};
  });
  const SampleMarks marks(poses.frames, tracks.tracks(), [&](std::size_t f, std::size_t n) {
    const std::size_t i = f * poses.channels + 3 * n;
    return missing[i] != 0 || missing[i + 1] != 0 || missing[i + 2] != 0;
  });
  const std::vector<double> one(tracks.tracks(), 1);
  std::vector<double> shares(tracks.tracks(), 1);
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    std::size_t seen = 0;
    for (std::size_t f = 0; f < tracks.frames(); ++f) seen += marks(f, n) == 0;
    if (seen < fewest_smoothed_frames) shares[n] = 0;
  }
  smooth_tracks(tracks, marks, one, shares, frame_rate_hz);
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const Vec3 v = tracks.at(f, n);
      poses(f, 3 * n) = v.x * noise[3 * n];
      poses(f, 3 * n + 1) = v.y * noise[3 * n + 1];
      poses(f, 3 * n + 2) = v.z * noise[3 * n + 2];
    }
  }
}

class Guard {
 public:
  Guard(const WienerPrior& prior, const WienerTake& take, const WienerSettings& settings)
      : prior_(prior), take_(take), settings_(settings) {}

  WienerResult run() {
    WienerResult result = wiener_filter(prior_, take_, settings_);
    const std::size_t frames = take_.poses.frames, channels = take_.poses.channels;
    if (frames < fewest_frames) return result;
    counted_ = result.rejected;
    samples_ = result.poses;
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      const bool is_observed = take_.observed.empty() || take_.observed[i] != 0;
      counted_[i] = is_observed && counted_[i] == 0 ? 1 : 0;
      if (counted_[i] != 0) samples_.values[i] = take_.poses.values[i];
    }
    learn_noise();
    Estimate estimate{result.poses, divergence(result)};
    mix(estimate, smoothed());
    result.poses = std::move(estimate.poses);
    std::vector<double> least = track_sums(risks(result.poses, estimate.divergence));
    for (double& risk : least) risk *= clearly;
    std::vector<std::size_t> best(least.size(), widths_s.size());
    std::vector<PoseMatrix> smooth(widths_s.size());
    std::vector<std::vector<double>> smooth_risks(widths_s.size());
    for_each_index(widths_s.size(), [&](std::size_t w) {
      const double sigma = widths_s[w] * take_.rate_hz;
      smooth[w] = samples_;
      gaussian_filter(smooth[w], sigma);
      smooth_risks[w] =
          track_sums(risks(smooth[w], std::vector<double>(channels, centre_weight(sigma))));
    });
    for (std::size_t w = 0; w < widths_s.size(); ++w) {
      for (std::size_t track = 0; track < least.size(); ++track) {
        if (smooth_risks[w][track] >= least[track]) continue;
        least[track] = smooth_risks[w][track];
        best[track] = w;
      }
    }
    for (std::size_t d = 0; d < channels; ++d) {
      const std::size_t w = best[d / channels_of_part];
      if (w == widths_s.size() || !is_mostly_counted(d)) continue;
      for (std::size_t f = 0; f < frames; ++f) result.poses(f, d) = smooth[w](f, d);
    }
    return result;
  }

 private:
  // Chosen by hand, not swept.
  static constexpr std::size_t fewest_frames = 16;  // fewer do not determine a risk

  bool is_mostly_counted(std::size_t channel) const {
    std::size_t count = 0;
    for (std::size_t f = 0; f < take_.poses.frames; ++f)
      count += counted_[f * take_.poses.channels + channel];
    return static_cast<double>(count) >= fewest_counted * static_cast<double>(take_.poses.frames);
  }

  // Mean square of fourth differences of the samples used: noise may vary over the take, and risks
  // are sums.
  void learn_noise() {
    const PoseMatrix& y = take_.poses;
    variance_.assign(y.channels, 0);
    for (std::size_t d = 0; d < y.channels; ++d) {
      const double typical = take_.noise[d] * take_.noise[d];
      double sum = 0, count = 0;
      const auto is_counted = [&](std::size_t sample) { return counted_[sample] != 0; };
      for_each_fourth_difference(y, d, is_counted, [&](double difference) {
        sum += std::min(difference * difference / fourth_difference_variance,
                        most_of_typical * typical);
        count += 1;
      });
      variance_[d] = std::max(count > 0 ? sum / count : typical, least_guard_variance);
    }
  }

  // The samples with a probe added, and the probe's signs.
  PoseMatrix probed(std::vector<double>& signs) const {
    PoseMatrix poses = samples_;
    signs.resize(poses.values.size());
    const Random random(probe_seed);
    for (std::size_t f = 0; f < poses.frames; ++f) {
      Random own = random.fork(f);
      for (std::size_t d = 0; d < poses.channels; ++d) {
        const std::size_t i = f * poses.channels + d;
        signs[i] = own.chance(0.5) ? 1 : -1;
        if (counted_[i] != 0) poses.values[i] += probe_share * take_.noise[d] * signs[i];
      }
    }
    return poses;
  }

  std::vector<double> divergence(const PoseMatrix& moved, const PoseMatrix& still,
                                 const std::vector<double>& signs) const {
    const std::size_t channels = still.channels;
    std::vector<double> sums(channels, 0), counts(channels, 0);
    for (std::size_t i = 0; i < signs.size(); ++i) {
      if (counted_[i] == 0) continue;
      const std::size_t d = i % channels;
      sums[d] += signs[i] * (moved.values[i] - still.values[i]) / (probe_share * take_.noise[d]);
      counts[d] += 1;
    }
    for (std::size_t d = 0; d < channels; ++d)
      sums[d] = std::clamp(sums[d] / std::max(counts[d], 1.0), 0.0, 1.0);
    return sums;
  }

  std::vector<double> divergence(const WienerResult& result) const {
    std::vector<double> signs;
    const PoseMatrix shaken = probed(signs);
    WienerSettings settings = settings_;
    settings.outlier_deviations = 0;
    const WienerTake again{shaken, result.poses, take_.observed, {}, take_.noise, take_.rate_hz};
    const WienerTake before{samples_, result.poses, take_.observed, {}, take_.noise, take_.rate_hz};
    return divergence(wiener_filter(prior_, again, settings).poses,
                      wiener_filter(prior_, before, settings).poses, signs);
  }

  Estimate smoothed() const {
    std::vector<std::uint8_t> missing(counted_.size());
    for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = counted_[i] == 0 ? 1 : 0;
    std::vector<double> deviations(variance_.size()), signs;
    std::transform(variance_.begin(), variance_.end(), deviations.begin(),
                   [](double variance) { return std::sqrt(variance); });
    Estimate estimate{samples_, {}};
    PoseMatrix shaken = probed(signs);
    smooth_channels(estimate.poses, missing, deviations, take_.rate_hz);
    smooth_channels(shaken, missing, deviations, take_.rate_hz);
    estimate.divergence = divergence(shaken, estimate.poses, signs);
    return estimate;
  }

  // Mixes each track as a x + (1 - a) other, with the a of least estimated risk, which is a
  // parabola in a.
  void mix(Estimate& x, const Estimate& other) const {
    const std::size_t channels = samples_.channels, tracks = (channels + 2) / channels_of_part;
    std::vector<double> slope(tracks, 0), curvature(tracks, 0);
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      if (counted_[i] == 0) continue;
      const std::size_t d = i % channels;
      const double step = x.poses.values[i] - other.poses.values[i];
      const double left = take_.poses.values[i] - other.poses.values[i];
      slope[d / channels_of_part] +=
          left * step - (x.divergence[d] - other.divergence[d]) * variance_[d];
      curvature[d / channels_of_part] += step * step;
    }
    std::vector<double> share(channels, 1);
    for (std::size_t d = 0; d < channels; ++d) {
      const std::size_t track = d / channels_of_part;
      if (curvature[track] > 0 && is_mostly_counted(d))
        share[d] = std::clamp(slope[track] / curvature[track], 0.0, 1.0);
      x.divergence[d] = share[d] * x.divergence[d] + (1 - share[d]) * other.divergence[d];
    }
    const std::vector<std::size_t> depth = gap_depths();
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      const double deep = static_cast<double>(depth[i]) / (gap_fade_s * take_.rate_hz);
      const double other_share = (1 - share[i % channels]) * std::max(0.0, 1 - deep);
      if (other_share <= 0) continue;  // the other estimate has no weight here
      x.poses.values[i] += other_share * (other.poses.values[i] - x.poses.values[i]);
    }
  }

  // F x D: frames to the nearest counted sample. The weight of the smoother decreases with depth
  // into a gap.
  std::vector<std::size_t> gap_depths() const {
    const std::size_t channels = samples_.channels, count = counted_.size();
    std::vector<std::size_t> depth(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (counted_[i] == 0) depth[i] = i < channels ? samples_.frames : depth[i - channels] + 1;
    }
    for (std::size_t i = count; i-- > 0;) {
      if (i + channels < count) depth[i] = std::min(depth[i], depth[i + channels] + 1);
    }
    return depth;
  }

  std::vector<double> risks(const PoseMatrix& x, const std::vector<double>& divergences) const {
    std::vector<double> sums(x.channels, 0);
    for (std::size_t i = 0; i < x.values.size(); ++i) {
      if (counted_[i] == 0) continue;
      const std::size_t d = i % x.channels;
      const double change = take_.poses.values[i] - x.values[i];
      sums[d] += change * change + (2 * divergences[d] - 1) * variance_[d];
    }
    return sums;
  }

  static std::vector<double> track_sums(const std::vector<double>& channels) {
    std::vector<double> tracks((channels.size() + 2) / channels_of_part, 0);
    for (std::size_t d = 0; d < channels.size(); ++d) tracks[d / channels_of_part] += channels[d];
    return tracks;
  }

  const WienerPrior& prior_;
  const WienerTake& take_;
  const WienerSettings& settings_;
  std::vector<std::uint8_t> counted_;  // F x D
  PoseMatrix samples_;                 // counted samples, and the filter's result elsewhere
  std::vector<double> variance_;       // D
};

}  // namespace

WienerResult guarded_wiener_filter(const WienerPrior& prior, const WienerTake& take,
                                   const WienerSettings& settings) {
  return Guard(prior, take, settings).run();
}

namespace {

// Passes (ablation_wiener.csv: "one pass over dense ones"); median deviations, and degrees, from
// which a sample is an outlier.
constexpr int passes = 2;
constexpr double outlier_deviations = 4;
constexpr double least_outlier_deg = 1;

bool is_observed(const WienerTake& take, std::size_t sample) {
  return take.observed.empty() || take.observed[sample] != 0;
}

// D: noise, outliers included.
std::vector<double> noise_with_outliers(const WienerTake& take) {
  const PoseMatrix& y = take.poses;
  std::vector<double> noise(take.noise.begin(), take.noise.end());
  for (std::size_t d = 0; d < y.channels; ++d) {
    double sum = 0, count = 0;
    const auto is_used = [&](std::size_t sample) { return is_observed(take, sample); };
    for_each_fourth_difference(y, d, is_used, [&](double difference) {
      sum += difference * difference / fourth_difference_variance;
      count += 1;
    });
    if (count > 0) noise[d] = std::max(noise[d], std::sqrt(sum / count));
  }
  return noise;
}

// Marks samples far from the estimate, and sets the noise to that of the other samples.
void judge(const WienerTake& take, const PoseMatrix& estimate, std::vector<std::uint8_t>& suspect,
           std::vector<double>& noise) {
  const std::size_t channels = estimate.channels;
  std::fill(suspect.begin(), suspect.end(), std::uint8_t{0});
  for (std::size_t d = 0; d < channels; ++d) {
    const auto distance = [&](std::size_t f) {
      return std::abs(take.poses(f, d) - estimate(f, d));
    };
    std::vector<double> distances;
    for (std::size_t f = 0; f < estimate.frames; ++f) {
      if (is_observed(take, f * channels + d)) distances.push_back(distance(f));
    }
    const double limit = std::max(
        least_outlier_deg, outlier_deviations * deviations_per_median * median_of(distances));
    double sum = 0, count = 0;
    const std::size_t first = d - d % 3, last = std::min(first + 3, channels);
    for (std::size_t f = 0; f < estimate.frames; ++f) {
      if (!is_observed(take, f * channels + d)) continue;
      if (distance(f) > limit) {
        for (std::size_t c = first; c < last; ++c)
          suspect[f * channels + c] = is_observed(take, f * channels + c) ? 1 : 0;
      } else {
        sum += distance(f) * distance(f);
        count += 1;
      }
    }
    if (count > 0) noise[d] = std::clamp(std::sqrt(sum / count), take.noise[d], noise[d]);
  }
}

// Replaces suspects by splines through the other samples.
void bridge(const WienerTake& take, const std::vector<std::uint8_t>& suspect, PoseMatrix& guess) {
  std::vector<std::uint8_t> missing = suspect;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (!is_observed(take, i)) missing[i] = 1;
  }
  PoseMatrix bridged = take.poses;
  fill_cubic(bridged, missing);
  for (std::size_t i = 0; i < suspect.size(); ++i) {
    if (suspect[i] != 0) guess.values[i] = bridged.values[i];
  }
}

}  // namespace

WienerOutliers dense_outliers(const WienerPrior& prior, const WienerTake& take) {
  WienerOutliers result{{take.suspect.begin(), take.suspect.end()}, take.guess};
  result.suspect.resize(take.poses.values.size(), 0);
  WienerSettings settings;
  settings.rounds = 1;
  // The set of suspects is fixed.
  settings.least_outlier_deg = std::numeric_limits<double>::max();
  std::vector<double> noise = noise_with_outliers(take);
  for (int pass = 0; pass < passes; ++pass) {
    PoseMatrix estimate =
        wiener_filter(
            prior, {take.poses, result.guess, take.observed, result.suspect, noise, take.rate_hz},
            settings)
            .poses;
    judge(take, estimate, result.suspect, noise);
    result.guess = std::move(estimate);
    bridge(take, result.suspect, result.guess);
  }
  return result;
}

}  // namespace kinemend
