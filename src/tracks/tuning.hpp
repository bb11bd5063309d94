#pragma once

#include <cstddef>

#include "signal/evidence.hpp"
#include "signal/leave_one_out.hpp"

// The constants of the method `auto`, by step. They were chosen by hand; no sweep of that time is
// kept. bench/papers/figures/auto_sweep.csv (tools/sweep) states what half, 0.8, 1.25 and 2 times
// each of them does to the error on seven takes that no other table of `auto` uses;
// docs/methods/auto-details.md sums it up.
namespace kinemend {

/// Of `replace_gross_spikes`.
struct GrossSpikeTuning {
  double ratio = 6;               ///< of a spike's deviation to the median deviation
  double least_deg = 6;           ///< deviation of a spike
  std::size_t window_frames = 8;  ///< on either side, of the median
  int passes = 4;                 ///< at most
};

/// Of `smooth_chart`.
struct ChartTuning {
  double width_s = 0.05;  ///< standard deviation of the Gaussian mean
};

/// Of `noise_levels` and `estimate_whitening`. Deviations are in degrees, per axis.
struct NoiseTuning {
  double minimum_bias = 1.01;     ///< the smaller of two estimates is biased low
  double least_axis_share = 0.5;  ///< of the largest deviation, of axes that count once whitened
  double least_level = 0.5;       ///< of tracks to be whitened, at 120 Hz: motion is not isotropic
  double log_ratio = 0.35;        ///< least logarithm of the ratio of deviations, in a long take
  double chance_log_ratio = 5;    ///< added to it by chance, over sqrt(number of differences)
  double largest_ratio = 10;      ///< of deviations, which limits the whitening
  std::size_t fewest_differences = 60;
  std::size_t most_differences = 4000;  ///< evenly spread; limits the time
  int rounds = 12;                      ///< of Tyler's fixed-point iteration
};

/// Of `find_spikes` and `classify_spikes`. Errors are those of predictions, in degrees.
struct SpikeTuning {
  // Candidates.
  double candidate_ratio = 6.5;  ///< of an error to its standard deviation
  signal::CutoffGrid predictors{0.3, 30, 10};
  double robust_cap = 6;        ///< deviations that limit an error when smoothers are compared
  int rounds = 5;               ///< at most
  double noise_floor = 0.25;    ///< assumed at least, degrees
  double least_error = 6;       ///< of a spike
  double median_half_s = 0.08;  ///< of the running median of errors
  // Isolation: thresholds of quiet tracks and of noisy ones.
  double clearance_quiet = 6;           ///< of an error to the largest about it
  double clearance_noisy = 2;           ///< the same
  std::size_t surrounding_frames = 12;  ///< on either side, which these errors are from
  double nearby_ratio = 3;              ///< of an error to those of nearby tracks
  // Continuation of one side.
  double side_error_share = 0.3;  ///< of the error, which this distance stays below
  // Speed of joints: the fastest known, a pitcher's shoulder, reaches about 7,500 degrees a second.
  double fastest_deg_s = 7500;
  double return_share = 0.25;   ///< of the error, between the samples beside a spike
  std::size_t longest_run = 2;  ///< frames
  // Clusters and recurrent spikes: those that chance does not explain are motion.
  double chance = 1e-4;           ///< probability below which it does not
  std::size_t cluster_gap = 8;    ///< frames between spikes of a cluster
  std::size_t usual_cluster = 2;  ///< spikes that need no further reason
  double recurrent_deg_s = 2000;  ///< mean speed of spikes that may be motion
  // Damage of quiet takes.
  double damage_count = 5;       ///< fewest spikes on quiet tracks
  double damage_share = 0.0006;  ///< and share of their samples
  double low_quantile = 0.1;     ///< of the sizes of spikes
  double smallest_share = 0.4;   ///< of that, below which an error is none
};

/// Of `smoothing_shares`. Noise in degrees per axis, at 120 Hz.
struct DeadZoneTuning {
  double start_noisy = 0.15;  ///< noise from which tracks are smoothed, in a noisy take
  double full_noisy = 0.35;   ///< noise from which they are smoothed fully
  double start_quiet = 0.35;  ///< the same in a quiet take
  double full_quiet = 0.7;
  double noisy_from = 0.15;     ///< median noise of a take that is not quiet; twice that is noisy
  double rate_exponent = 0.75;  ///< of 120 Hz over the frame rate, by which all of these grow
};

/// Of `clean_tracks` and `smooth_tracks`.
struct SmoothingTuning {
  double axes_window_s = 0.1;  ///< half of the moving averages that separate slow motion
  double noise_floor = 1e-4;   ///< degrees, against division by zero
  signal::CutoffGrid models{0.003, 50, 30};
  signal::AdaptiveSettings adaptive;
};

struct TrackTuning {
  NoiseTuning noise;
  SpikeTuning spikes;
  DeadZoneTuning dead_zone;
  SmoothingTuning smoothing;
};

}  // namespace kinemend
