// Computes the posterior mean of a take under the prior of `wiener`, window by window: the
// likelihood of the coefficients of a window, and the posterior of the mixture for windows with the
// same missing samples.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "methods/wiener/wiener_prior.hpp"

namespace kinemend {

/// Windows of one take with the same missing samples.
struct WindowGroup {
  /// A channel whose missing samples are left out instead of guessed, as there are many.
  struct Lost {
    Eigen::Index channel = 0;
    std::vector<Eigen::Index> seen;  ///< frames of the window that were measured
    Eigen::MatrixXd precision;       ///< K x K, A = Phi^T Phi / v over the frames seen
    Eigen::MatrixXd damping;         ///< K x K, (I + A rest)^-1
  };
  std::vector<std::size_t> windows;
  std::vector<Lost> lost;
};

/// Cuts a take into windows. If a channel lacks more than an eighth of a window's samples, the
/// missing ones are left out of the window: the coefficients are then conditioned on the others.
/// Otherwise they are taken from `poses`, which holds a guess.
class WienerWindows {
 public:
  /// `prior`: with at most as many coefficients as a window has frames. `noise`: D, positive,
  /// degrees.
  WienerWindows(const WienerPrior& prior, Eigen::Index window_frames, Eigen::Index frames,
                std::span<const std::uint8_t> observed, std::span<const double> noise);

  const std::vector<WindowGroup>& groups() const noexcept { return groups_; }
  const std::vector<Eigen::Index>& starts() const noexcept { return starts_; }
  const WindowGroup& group_of(std::size_t window) const { return groups_[owner_[window]]; }
  Eigen::Index frames() const noexcept { return frames_; }

  /// N x D: all coefficients of a window; frames beyond the end of the take repeat the last.
  Eigen::MatrixXd coefficients(const PoseMatrix& poses, std::size_t window) const;
  /// D K: u = S^-1 (y - mean), where S is the covariance of noise and rest.
  Eigen::VectorXd information(const PoseMatrix& poses, std::size_t window,
                              const Eigen::MatrixXd& coefficients) const;
  /// R x R: J = basis^T S^-1 basis.
  Eigen::MatrixXd precision(const WindowGroup& group) const;
  /// D: noise of a coefficient, v / N.
  const Eigen::VectorXd& noise() const noexcept { return noise_; }
  const Eigen::MatrixXd& cosines() const noexcept { return cosines_; }

 private:
  std::vector<bool> lost_samples(Eigen::Index start, std::span<const std::uint8_t> observed) const;
  WindowGroup group_for(const std::vector<bool>& lost) const;

  const WienerPrior& prior_;
  Eigen::Index frames_, take_frames_;
  Eigen::VectorXd noise_;
  Eigen::MatrixXd cosines_;  // N x N
  Eigen::VectorXd whole_;    // D K: diagonal of S^-1 where nothing is missing
  std::vector<Eigen::Index> starts_;
  std::vector<WindowGroup> groups_;
  std::vector<std::size_t> owner_;
};

/// The posterior of z given windows with the same precision J (R x R) and their information
/// h = basis^T u (R x W, one column per window): for component c
///
///     P_c = (C_c^-1 + J)^-1,    z_c = P_c (C_c^-1 m_c + h),
///     log p(y | c) = 1/2 (log |P_c| - log |C_c| - m_c^T C_c^-1 m_c + b^T P_c b) + the same for all
///
/// with b = C_c^-1 m_c + h. Components are weighted by that evidence.
struct MixturePosterior {
  Eigen::MatrixXd shares;              ///< C x W, columns sum to 1
  std::vector<Eigen::MatrixXd> means;  ///< C of R x W

  /// The posterior mean of the mixture, R x W.
  Eigen::MatrixXd mean() const;
};
MixturePosterior mixture_posterior(const std::vector<WienerPrior::Component>& components,
                                   const Eigen::MatrixXd& precision,
                                   const Eigen::MatrixXd& information);

struct WienerSettings {
  /// How often samples are judged again, and those without weight estimated again.
  std::size_t rounds = 2;
  /// Standard deviations beyond which a sample gets no weight; 0 keeps all.
  double outlier_deviations = 4.5;
  double least_outlier_deg = 1;  ///< samples at a smaller distance are not outliers
};

struct WienerTake {
  const PoseMatrix& poses;                 ///< F x D
  const PoseMatrix& guess;                 ///< F x D, for samples that are missing or suspect
  std::span<const std::uint8_t> observed;  ///< F x D; empty: all
  std::span<const std::uint8_t> suspect;   ///< F x D, 1: initial outliers; empty: none
  std::span<const double> noise;           ///< D, positive: standard deviations, degrees
  double rate_hz = 120;
};

struct WienerResult {
  PoseMatrix poses;                    ///< the posterior means
  std::vector<std::uint8_t> rejected;  ///< F x D, 1 where an observed sample had no weight
};

/// The posterior mean of a take, window by window and overlap-added. Components are weighted by the
/// evidence of each window. The residual is shrunk by its own spectrum (`RestModel`). A sample far
/// from its window's estimate is rejected, and stays so. Each estimate replaces missing and
/// rejected samples. Channels come in threes, which share outliers.
WienerResult wiener_filter(const WienerPrior& prior, const WienerTake& take,
                           const WienerSettings& settings = {});

}  // namespace kinemend
