#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/pose_matrix.hpp"

// Multi-channel singular spectrum analysis (Lou & Chai 2010, section 3.1).
//
// A window of M frames x L channels is one vector of M L numbers, frame after frame: a stretch of a
// PoseMatrix as it lies in memory. The paper orders its columns by channels instead, which changes
// no basis but for the order of its entries.
namespace kinemend {

/// The grand lag covariance matrix (eq. 3-5) of any number of sequences, each shown once and not
/// kept. The trajectory matrix is never formed: two blocks next to each other on a diagonal differ
/// by what the ends of the sequence add, so that only those of the first row need full sums. Memory
/// is two (M L)^2 matrices, however many sequences there are.
class LagCovariance {
 public:
  LagCovariance(std::size_t window_frames, std::size_t channels);

  /// Sequences shorter than a window are left out. `weight` counts for each of its windows, > 0.
  void add(const PoseMatrix& sequence, double weight = 1);

  /// The number of windows (S_N), weighted.
  double windows() const noexcept { return windows_; }
  /// L: of all frames of all sequences that were not left out, weighted.
  std::vector<double> mean() const;
  /// M L x M L, row-major, symmetric. Centred: of the channels less their means; else of the raw
  /// channels, as in the paper. Zeros when there was no window.
  std::vector<double> covariance(bool centred = true);
  /// The same of the channels less `centre` (L).
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
  std::vector<double> ends_;        // rows of (M-1) L that wait to be added to steps_
  std::vector<double> weighted_ends_;
};

/// Orthonormal spatial-temporal patterns of motion.
struct FilterBases {
  std::size_t window_frames = 0;    ///< M
  std::size_t channels = 0;         ///< L
  std::size_t count = 0;            ///< K
  std::vector<double> bases;        ///< M L x K, row-major: E of eq. 10
  std::vector<double> eigenvalues;  ///< K, falling: variance of each coefficient
  std::vector<double> mean;         ///< L; zeros when not centred
  std::vector<double> residual;     ///< L: mean variance of a sample that the bases leave
  double total_energy = 0;          ///< sum of all M L eigenvalues
};

struct BasesLimits {
  double energy = 0.99;   ///< share of the energy to be kept, 0..1 (the paper: 0.99)
  std::size_t count = 0;  ///< as many instead; 0: by energy
};

/// The leading eigenvectors of the covariance. Their signs make the entry of largest size positive.
/// Errors: `ErrorKind::usage` when there was no window.
FilterBases filter_bases(LagCovariance& covariance, const BasesLimits& limits = {},
                         bool centred = true);

/// Puts the spread of motion that was not learned from in the place of eigenvalues and residual:
/// each half's bases are held against the other half's covariance, and of every rank and channel
/// the mean of both is taken. What bases keep of their own takes says too little of what they will
/// leave of others.
void cross_validate(FilterBases& bases, LagCovariance& half, LagCovariance& other_half,
                    bool centred = true);

}  // namespace kinemend
