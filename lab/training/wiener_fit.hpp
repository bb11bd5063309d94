// Fits the prior of `wiener` to sequences of motion in two passes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "lab/training/training_stages.hpp"
#include "lab/training/window_moments.hpp"
#include "methods/wiener/wiener_prior.hpp"

namespace kinemend {

struct WienerFitSettings {
  double rate_hz = 120;  ///< of the sequences
  double window_s = 0.5;
  std::size_t coefficients = 20;  ///< K, at most the frames of a window
  std::size_t rank = 120;         ///< R, at most K times the channels
  std::size_t components = 8;
  std::size_t rounds = 10;       ///< of expectation and maximisation
  double pooling = 300;          ///< weight of the pooled covariance in each component, in windows
  std::size_t windows = 12'000;  ///< drawn at random to fit the mixture
  std::uint64_t seed = 1;
};

/// Fits a prior in two passes over the same sequences: the first sums the moments of all windows,
/// which give mean, basis and rest; the second keeps a random sample of the windows in that basis
/// for the mixture. Memory is independent of the number of sequences.
class WienerFit {
 public:
  /// `channels`: D, 1 or more.
  WienerFit(std::size_t channels, const WienerFitSettings& settings);

  std::size_t window_frames() const noexcept;
  /// `half`: 0 or 1, the takes' halves for cross-validation.
  void add_moments(const PoseMatrix& sequence, double weight = 1, std::size_t half = 0);
  /// Called between the passes. Errors: `ErrorKind::usage` if there was no window.
  void find_basis();
  void add_windows(const PoseMatrix& sequence);
  /// After both passes: their results as bytes, and restoring a fit from them. Errors: as of
  /// `StageReader`.
  std::string stored() const;
  void restore(std::string_view bytes);
  /// Resumes and keeps the state of the stage "mixture" if `stages` is given.
  WienerPrior finish(TrainingStages* stages = nullptr) const;

 private:
  // One column per window, all N coefficients, channel-major. Windows in which a channel jumps by
  // half a turn are skipped.
  Eigen::MatrixXd coefficients_of(const PoseMatrix& sequence) const;
  Eigen::MatrixXd low(const Eigen::MatrixXd& all) const;

  WienerFitSettings settings_;
  Eigen::Index channels_, frames_, coefficients_;
  Eigen::MatrixXd cosines_;
  std::array<WindowMoments, 2> halves_;  // D K
  Eigen::MatrixXd tail_;                 // D x N: second moments of single coefficients
  WienerPrior prior_;
  std::vector<Eigen::VectorXd> sample_;
  std::uint64_t seen_ = 0;
};

}  // namespace kinemend
