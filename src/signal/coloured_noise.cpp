// Builds the precision of coloured noise and the evidence of channels under it.
#include "signal/coloured_noise.hpp"

#include "base/portable.hpp"

namespace kinemend::signal {

void NoisePrecision::set_channel(std::size_t channel, double correlation,
                                 std::span<const std::uint8_t> missing) {
  const double variance = 1 - correlation * correlation;  // of the innovation in a frame
  const auto is_missing = [&](std::size_t t) { return !missing.empty() && missing[t] != 0; };
  log_determinant[channel] = observed[channel] = 0;
  for (std::size_t t = 0; t < weight.frames; ++t) {
    coupling(t, channel) = 0;
    weight(t, channel) = 0;
    if (is_missing(t)) continue;
    observed[channel] += 1;
    if (t == 0 || is_missing(t - 1)) {
      weight(t, channel) = 1;
      continue;
    }
    weight(t, channel) = 1 / variance;
    weight(t - 1, channel) += correlation * correlation / variance;
    coupling(t - 1, channel) = -correlation / variance;
    log_determinant[channel] -= portable::log(variance);
  }
}

ColouredEvidence evidence_of(const ChannelBlock& y, const NoisePrecision& precision,
                             const SmoothingModel& model) {
  const std::size_t differences = y.frames - model.order;
  const ChannelBlock penalty(differences, model.strength);
  ChannelBlock x = y, scratch(y.frames);
  WeightedSystem system(y.frames, model.order, &precision.coupling);
  system.factor(precision.weight, penalty);
  system.refine(precision.weight, penalty, y, x, scratch);
  ColouredEvidence evidence;
  // The minimum of the fit's objective, which hardly depends on the fit's last digits.
  const auto c = difference_coefficients(model.order);
  for (std::size_t t = 0; t < y.frames; ++t) {
    for (std::size_t i = 0; i < block_channels; ++i) {
      const double rest = y(t, i) - x(t, i);
      evidence.squares[i] += precision.weight(t, i) * rest * rest;
      if (t + 1 < y.frames) {
        evidence.squares[i] += 2 * precision.coupling(t, i) * rest * (y(t + 1, i) - x(t + 1, i));
      }
    }
    if (t >= differences) continue;
    for (std::size_t i = 0; i < block_channels; ++i) {
      double difference = 0;
      for (std::size_t k = 0; k <= model.order; ++k) difference += c[k] * x(t + k, i);
      evidence.squares[i] += model.strength * difference * difference;
    }
  }
  evidence.logarithms = system.log_determinants();
  for (std::size_t i = 0; i < block_channels; ++i) {
    evidence.differences[i] = precision.observed[i] - static_cast<double>(model.order);
    evidence.logarithms[i] -= precision.log_determinant[i] +
                              static_cast<double>(differences) * portable::log(model.strength);
  }
  return evidence;
}

}  // namespace kinemend::signal
