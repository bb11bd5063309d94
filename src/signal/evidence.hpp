// Chooses the strength of smoothing for each channel by the likelihood of models, then lets it
// follow the motion. The noise is white, or a first-order autoregressive process, whose spectrum is
// flat up to a corner and falls with the square of the frequency beyond it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "signal/whittaker.hpp"

namespace kinemend::signal {

/// Model of a channel: differences of this order are white, their variance `strength` times smaller
/// than that of the noise.
struct SmoothingModel {
  std::size_t order = 0;  ///< 0: the take is too short for any
  double strength = 0;    ///< noise variance over the variance of the differences
};

/// Models of each of these orders with these cutoffs, if below 0.45 of the rate. Models of one
/// order are adjacent.
std::vector<SmoothingModel> models_of_orders(std::span<const std::size_t> orders,
                                             const CutoffGrid& cutoffs, std::size_t frames,
                                             double frame_rate_hz);

/// The models compared: orders 1 to 3, with all cutoffs below 0.45 of the frame rate.
class ModelGrid {
 public:
  ModelGrid(std::size_t frames, double frame_rate_hz, const CutoffGrid& cutoffs = {0.003, 50, 30});

  std::size_t frames() const noexcept { return frames_; }
  double frame_rate_hz() const noexcept { return frame_rate_hz_; }
  const std::vector<SmoothingModel>& models() const noexcept { return models_; }
  const SharedFactor& factor(std::size_t model) const { return factors_[model]; }
  const std::vector<SharedFactor>& factors() const noexcept { return factors_; }

 private:
  std::size_t frames_;
  double frame_rate_hz_;
  std::vector<SmoothingModel> models_;
  std::vector<SharedFactor> factors_;
};

/// The most likely model of each of the first channels of `y`, one per variance: the one with the
/// largest marginal likelihood of the channel under white noise of variance `noise_variance[c]` (>
/// 0). With `group` above 1 that many neighbouring channels (a divisor of their number, at most 8)
/// share the model that is most likely for all of them. Returns the index of each channel's model
/// in the grid's list, which must not be empty.
std::vector<std::size_t> most_likely_models(const ChannelBlock& y,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group = 1);
/// Smooths the first channels of `y` in place, each with the model of that index.
void smooth_with(const ModelGrid& grid, std::span<const std::size_t> models, ChannelBlock& y);

/// The models of all channels of a matrix; empty if no model exists for its few frames.
std::vector<std::size_t> most_likely_models(const PoseMatrix& matrix,
                                            std::span<const double> noise_variance,
                                            const ModelGrid& grid, std::size_t group = 1);

/// Chosen by hand; docs/details/auto.md states what other values do (`smoothing.adaptive`).
struct AdaptiveSettings {
  /// Window of the moving average of squared differences, applied twice; at least three frames.
  double window_s = 0.05;
  double share_of_constant = 0;  ///< share of the model's constant variance in the result
  int iterations = 4;
};

/// Smooths the channels of `matrix` in place with strengths that follow the motion: starting from
/// each channel's `model`, the variance of the differences is estimated about each frame
/// (expectation-maximisation: squared differences of the fit plus their posterior variances) and
/// the fit is repeated. `missing` is F x D, not 0 for samples without weight; empty: none.
void smooth_adaptively(PoseMatrix& matrix, std::span<const std::uint8_t> missing,
                       std::span<const double> noise_variance,
                       std::span<const SmoothingModel> models, double frame_rate_hz,
                       const AdaptiveSettings& settings = {});

/// The same for a block whose channels have models of one order, one per channel; further channels
/// are not used. `weight`: 1 / noise variance, 0 for missing samples; 1 for unused channels.
/// `coupling`: as of `WeightedSystem`, for coloured noise; nullptr: none.
ChannelBlock smooth_adaptively(const ChannelBlock& y, const ChannelBlock& weight,
                               std::span<const double> noise_variance,
                               std::span<const SmoothingModel> models, double frame_rate_hz,
                               const AdaptiveSettings& settings = {},
                               const ChannelBlock* coupling = nullptr);
/// Calls work(channels), in parallel, for blocks of up to eight channels of one order. All channels
/// are covered, except those of order 0.
void for_each_of_one_order(std::span<const SmoothingModel> models,
                           const std::function<void(const std::vector<std::size_t>&)>& work);

/// Columns `channels` of a matrix as a block; the rest of the block is zero.
ChannelBlock gather(const PoseMatrix& matrix, std::span<const std::size_t> channels);
void scatter(const ChannelBlock& block, std::span<const std::size_t> channels, PoseMatrix& matrix);

/// The precision of such noise of variance 1 on eight channels: `weight` along the diagonal,
/// `coupling` of each frame with the next. A missing sample has neither, and noise after it is
/// independent of that before.
struct NoisePrecision {
  ChannelBlock weight, coupling;
  BlockRow log_determinant{}, observed{};  ///< of unused channels 0

  explicit NoisePrecision(std::size_t frames) : weight(frames, 1), coupling(frames) {}
  /// Sets the precision of one channel; `missing` is empty if no sample is missing. `correlation`:
  /// of neighbouring frames, from 0 to below 1.
  void set_channel(std::size_t channel, double correlation, std::span<const std::uint8_t> missing);
};

/// The parts of a channel's evidence: -2 log p(y) under noise of variance s is `squares / s +
/// logarithms + differences log s`, up to terms that all models share.
struct ColouredEvidence {
  BlockRow squares{}, logarithms{}, differences{};
};
ColouredEvidence evidence_of(const ChannelBlock& y, const NoisePrecision& precision,
                             const SmoothingModel& model);

}  // namespace kinemend::signal
