// Computes bases of motion by multi-channel singular spectrum analysis (Lou & Chai 2010, section
// 3.1), and samples them at a clip's frames. A window is a contiguous part of a PoseMatrix, frame
// after frame; the paper orders it by channels, which only reorders a basis's entries.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"

namespace kinemend {

/// The grand lag covariance matrix (eq. 3-5) of any number of sequences, which are not kept. The
/// trajectory matrix is not formed: two adjacent blocks on a diagonal differ by terms of the
/// sequence's ends, so that only those of the first row need full sums. Memory is two (M L)^2
/// matrices, however many sequences there are.
class LagCovariance {
 public:
  LagCovariance(std::size_t window_frames, std::size_t channels);

  /// Sequences shorter than a window are skipped. `weight`: of each window, > 0.
  void add(const PoseMatrix& sequence, double weight = 1);

  /// The number of windows (S_N), weighted.
  double windows() const noexcept { return windows_; }
  /// L: mean of all frames of all sequences used, weighted.
  std::vector<double> mean() const;
  /// M L x M L, row-major, symmetric. Centred: of the channels less their means; else of the raw
  /// channels, as in the paper. Zeros if there was no window.
  std::vector<double> covariance(bool centred = true);
  /// The same for the channels less `centre` (L).
  std::vector<double> covariance_about(std::span<const double> centre);

  std::size_t window_frames() const noexcept { return window_; }
  std::size_t channels() const noexcept { return channels_; }

 private:
  void keep_ends(const PoseMatrix& sequence, double weight);
  void add_ends();

  std::size_t window_, channels_;
  double windows_ = 0, frames_ = 0;
  std::vector<double> frame_sum_;   // L
  std::vector<double> window_sum_;  // M L
  std::vector<double> first_row_;   // L x M L: blocks (0, j)
  std::vector<double> steps_;       // (M-1) L squared: block (j+1, j'+1) less block (j, j')
  std::vector<double> ends_;        // rows of (M-1) L still to be added to steps_
  std::vector<double> weighted_ends_;
};

/// Orthonormal spatial-temporal patterns of motion.
struct FilterBases {
  std::size_t window_frames = 0;    ///< M
  std::size_t channels = 0;         ///< L
  std::size_t count = 0;            ///< K
  std::vector<double> bases;        ///< M L x K, row-major: E of eq. 10
  std::vector<double> eigenvalues;  ///< K, descending: variance of each coefficient
  std::vector<double> mean;         ///< L; zeros when not centred
  std::vector<double> residual;     ///< L: mean variance of a sample outside the bases
  double total_energy = 0;          ///< sum of all M L eigenvalues
};

struct BasesLimits {
  double energy = 0.99;   ///< share of the energy kept, 0..1 (the paper: 0.99)
  std::size_t count = 0;  ///< number instead; 0: by energy
};

/// The leading eigenvectors of the covariance. Their signs make the entry of largest size positive.
/// Errors: `ErrorKind::usage` if there was no window.
FilterBases filter_bases(LagCovariance& covariance, const BasesLimits& limits = {},
                         bool centred = true);

/// Replaces eigenvalues and residual by cross-validated ones: each half's bases are applied to the
/// other half's covariance, and both results averaged for every rank and channel. The residual of
/// the training takes is biased low.
void cross_validate(FilterBases& bases, LagCovariance& half, LagCovariance& other_half,
                    bool centred = true);

/// Filter bases as functions of time, sampled at a clip's frames.
struct WindowBases {
  std::size_t frames = 0;    ///< of a window, M' of the clip
  std::size_t hop = 1;       ///< frames from one sliding window to the next: one frame of the model
  std::size_t channels = 0;  ///< L
  std::size_t count = 0;     ///< K
  /// M' L x K, row-major. With an `interpolation` the model's own values, M L x K.
  std::vector<double> values;
  /// Whether the columns of `values` are orthonormal (to the precision of the model's file): whole
  /// windows at the model's own rate.
  bool orthonormal = false;
  /// M' x M, row-major: frames of the clip as weighted sums of frames of the model. Empty: `values`
  /// are sampled at the clip's frames already.
  std::vector<double> interpolation = {};

  bool is_interpolated() const noexcept { return !interpolation.empty(); }
  /// M, of an interpolated window.
  std::size_t model_frames() const noexcept { return interpolation.size() / frames; }
};

/// Bases that would have more values at the rate of the clip (32 MB) keep the model's frames, so
/// that memory does not grow with the rate. Not swept.
inline constexpr std::size_t most_sampled_values = std::size_t{1} << 22;

/// The bases at the rate of a clip of `clip_frames` frames (1 or more), by a cubic spline through
/// their M frames. A clip shorter than a window gets the middle of the window. `count`: number of
/// leading bases; 0: all. Bases that would have more than `most_values` are interpolated.
WindowBases bases_at_rate(const FilterBases& bases, double model_rate_hz, double clip_rate_hz,
                          std::size_t clip_frames, std::size_t count = 0,
                          std::size_t most_values = most_sampled_values);

}  // namespace kinemend
