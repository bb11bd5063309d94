// Noise that is correlated from frame to frame, a first-order autoregressive process: its
// correlation falls by the same factor with each frame, its spectrum is flat up to a corner and
// falls with the square of the frequency beyond it. White noise is the case 0.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "signal/evidence.hpp"
#include "signal/whittaker.hpp"

namespace kinemend::signal {

/// The precision of such noise of variance 1 on eight channels: `weight` along the diagonal,
/// `coupling` of each frame with the next. A sample that is missing has none, and noise behind it
/// is taken to be new.
struct NoisePrecision {
  ChannelBlock weight, coupling;
  BlockRow log_determinant{}, observed{};  ///< of unused channels 0

  explicit NoisePrecision(std::size_t frames) : weight(frames, 1), coupling(frames) {}
  /// Of one channel; `missing` is empty where none is. `correlation`: of neighbouring frames, 0 to
  /// below 1.
  void set_channel(std::size_t channel, double correlation, std::span<const std::uint8_t> missing);
};

/// What the evidence of a channel is made of: -2 log p(y) under noise of variance s is
/// `squares / s + logarithms + differences log s`, but for what is the same for all models.
struct ColouredEvidence {
  BlockRow squares{}, logarithms{}, differences{};
};
ColouredEvidence evidence_of(const ChannelBlock& y, const NoisePrecision& precision,
                             const SmoothingModel& model);

}  // namespace kinemend::signal
