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
