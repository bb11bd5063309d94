// The constants of the method `auto`, by step. They were chosen by hand; no sweep of that time is
// kept. lab/experiments/figures/auto_sweep.csv (tools/sweep) states how half, 0.8, 1.25 and 2 times
// each of them change the error on seven takes that no other table of `auto` uses.
// auto_sweep_colour.csv states this for half and double of those of `ColourTuning` and
// `HeldTuning`. docs/details/auto.md summarises it.
#pragma once

#include <cstddef>

#include "signal/evidence.hpp"
#include "signal/leave_one_out.hpp"

namespace kinemend {

/// The constants of `replace_gross_spikes`.
struct GrossSpikeTuning {
  double ratio = 6;               ///< of a spike's deviation to the median deviation
  double least_deg = 6;           ///< deviation of a spike
  std::size_t window_frames = 8;  ///< on either side, of the median
  int passes = 4;                 ///< at most
};

/// The constants of `smooth_chart`.
struct ChartTuning {
  double width_s = 0.05;  ///< standard deviation of the Gaussian mean
};

/// The constants of `noise_levels` and `estimate_whitening`. Deviations are in degrees, per axis.
struct NoiseTuning {
  double minimum_bias = 1.01;     ///< the smaller of two estimates is biased low
  double least_axis_share = 0.5;  ///< of the largest deviation, for axes used once whitened
  double least_level = 0.5;       ///< of tracks to be whitened, at 120 Hz: motion is not isotropic
  double log_ratio = 0.35;        ///< least logarithm of the ratio of deviations, in a long take
  double chance_log_ratio = 5;    ///< added to it by chance, over sqrt(number of differences)
  double largest_ratio = 10;      ///< of deviations, which limits the whitening
  std::size_t fewest_differences = 60;
  std::size_t most_differences = 4000;  ///< evenly spread; limits the time
  int rounds = 12;                      ///< of Tyler's fixed-point iteration
};

/// The constants of `find_spikes` and `classify_spikes`. Errors are prediction errors, in degrees.
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
  std::size_t surrounding_frames = 12;  ///< on either side, from which these errors are
  double nearby_ratio = 3;              ///< of an error to those of nearby tracks
  // Continuation of one side.
  double side_error_share = 0.3;  ///< of the error; largest distance to that side
  // Speed of joints: the fastest known, a pitcher's shoulder, reaches about 7,500 degrees a second.
  double fastest_deg_s = 7500;
  double return_share = 0.25;   ///< of the error, between the samples beside a spike
  std::size_t longest_run = 2;  ///< frames
  // Clusters and recurrent spikes: those that chance does not explain are motion.
  double chance = 1e-4;           ///< probability below which it does not
  std::size_t cluster_gap = 8;    ///< frames between spikes of a cluster
  std::size_t usual_cluster = 2;  ///< spikes that need no further reason
  double recurrent_deg_s = 2000;  ///< mean speed of spikes that may be motion
  double move_share = 0.5;        ///< of the error: largest distance between samples of a move
  // Damage of quiet takes.
  double damage_count = 5;       ///< fewest spikes on quiet tracks
  double damage_share = 0.0006;  ///< and share of their samples
  double low_quantile = 0.1;     ///< of the sizes of spikes
  double smallest_share = 0.4;   ///< of that; smaller errors are not spikes
};

/// The constants of `dense_outliers`. Errors are in degrees.
struct DenseTuning {
  double least_share = 0.04;        ///< of the samples of a track, from which outliers are dense
  double least_error = 6;           ///< of an outlier
  double ratio = 6.5;               ///< of its error to the deviation of the samples about it
  double least_apart = 0.5;         ///< of its error, from its neighbours or from their errors
  double wide_half_s = 0.1;         ///< of the window of medians and of the first quadratics
  double curve_half_s = 0.05;       ///< of the window of the last quadratics
  double scale_half_s = 0.16;       ///< of the running median of errors
  double least_scale = 0.25;        ///< deviation assumed at least, degrees
  double welsch_deviations = 3.25;  ///< at which the weight of a sample falls to 0.6
  int rounds = 4;                   ///< of fitting and weighing
  std::size_t fewest_outliers = 5;  ///< of a track
};

/// The constants of `agreement_of`.
struct AgreementTuning {
  double lowest_rate_hz = 50;     ///< from which noise is quicker than any motion
  double shortest_s = 4;          ///< of takes whose quiet moments distinguish motion from noise
  std::size_t fewest_tracks = 6;  ///< that move
  double start = 0.7;             ///< share of them, above which noise starts to be accepted
  double full = 0.9;              ///< and above which it is fully accepted
};

/// The constants of `smoothing_shares`. Noise in degrees per axis, at 120 Hz.
struct DeadZoneTuning {
  double start_noisy = 0.15;  ///< noise from which tracks are smoothed, in a noisy take
  double full_noisy = 0.35;   ///< noise from which they are smoothed fully
  double start_quiet = 0.35;  ///< the same in a quiet take
  double full_quiet = 0.7;
  double noisy_from = 0.15;     ///< median noise of a take that is not quiet; twice that is noisy
  double rate_exponent = 0.75;  ///< of 120 Hz over the frame rate, which scales all of these
};

/// The constants of `clean_tracks` and `smooth_tracks`.
struct SmoothingTuning {
  double axes_window_s = 0.1;  ///< half of the moving averages that separate slow motion
  double noise_floor = 1e-4;   ///< degrees, against division by zero
  signal::CutoffGrid models{0.003, 50, 30};
  signal::AdaptiveSettings adaptive;
};

/// The constants of `noise_spectrum_of`, `coloured_shares` and `smooth_coloured`. Candidates
/// (correlations, strengths, cutoffs) and limits of time and memory are defined where they are
/// used.
struct ColourTuning {
  double least_noise = 0.05;  ///< degrees at 120 Hz: least median white noise to examine
  // Evidence.
  std::size_t few_windows = 4;      ///< in which white noise is recognised
  std::size_t few_marked = 3;       ///< marked samples in a run that is interpolated
  std::size_t fewest_samples = 12;  ///< observed, of a window
  std::size_t fewest_tracks = 4;    ///< that move
  std::size_t fewest_seconds = 4;   ///< of positions: markers stand still for a second or two
  /// Share of the tracks. Noise comes from the system and has one colour for all tracks: if white
  /// noise is proportional to the motion, quiet tracks look coloured and the others do not (0.48 of
  /// them at most; at least 0.95 for coloured noise, synthetic and real).
  double least_agreement = 0.75;
  // Clear noise, by its strength at the highest frequencies, at 120 Hz. Noise of 1.5 degrees with a
  // correlation of 0.95 has at least 0.22 degrees and a product of 0.59; clean clips have at most
  // 0.14 degrees. Clean markers that hardly move have noise over speed, too: slow dances at 30 and
  // 60 Hz reach that of video and depth cameras; distances distinguish them.
  double least_rotation_deg = 0.18;
  double least_of_rotations = 0.43;  ///< square of degrees, times milliseconds
  double least_deg = 0.05;           ///< of positions
  double least_ms = 1.8;             ///< of positions
  double least_product = 1;          ///< of both, at the rate of the take
  /// Share of the noise in the distances of positions. Real noise of video and depth cameras has a
  /// tenth or more, even if a solver nearly keeps bone lengths; clean markers mistaken for noisy
  /// have a hundredth at most.
  double least_in_distances = 0.03;
  // Dead zone: degrees at 120 Hz, at the highest frequencies.
  double start = 0.02;  ///< from which tracks are smoothed
  double full = 0.05;   ///< from which they are smoothed fully
  // Slow noise of positions.
  double slow_correlation = 0.8;  ///< from which noise is slow
  double longest_s = 30;          ///< of each of the two stretches used
  double most_of_quiet = 4;       ///< times that of the windows, at most
  double trembling_s = 0.04;  ///< deviation of the Gaussian that removes what is left above 5 Hz
  // Quiet spans of slow noise do not determine their motion well.
  double share_of_constant = 0.2;  ///< `signal::AdaptiveSettings`
};

/// The constants of `find_sample_pattern`. The longest step, 8 frames, limits time and memory.
struct HeldTuning {
  std::size_t fewest_samples = 8;
  /// Largest ratio of differences between measurements to those at them. A chart bends held or
  /// straight samples by up to some percent, interpolated Euler angles by more.
  double largest_ratio = 0.2;
  double least_difference = 1e-5;  ///< degrees: a track that does not move shows no pattern
  double agreeing_tracks = 0.9;    ///< share of those that move
  double large_quantile = 0.9;     ///< of differences; spikes are above it
  double least_clock_step = 1.1;   ///< frames
};

struct TrackTuning {
  NoiseTuning noise;
  SpikeTuning spikes;
  DenseTuning dense;
  DeadZoneTuning dead_zone;
  AgreementTuning agreement;
  SmoothingTuning smoothing;
  ColourTuning colour;
  HeldTuning held;
};

}  // namespace kinemend
