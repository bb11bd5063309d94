// Finds other times of a take at which a track moves as it does around a gap.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fill/curves.hpp"

namespace kinemend::fill {

/// Another time of the take at which a track moves as it does around a span.
struct Cycle {
  std::ptrdiff_t lag = 0;  ///< frame f of the span resembles frame f + lag
  /// Difference of the surroundings: 0 identical, 1 no better than a straight line.
  double mismatch = 0;
};

/// These are not swept, except `farthest_s`, which bounds the run time.
struct CycleSettings {
  double largest_mismatch = 0.35;
  std::size_t most_cycles = 3;
  double farthest_s = 15;  ///< the largest lag, in either direction
};

/// The lags at which the samples around the span (half its length on either side, 0.15 to 0.5 s)
/// repeat best: local minima of
///
///     m(s)^2 = sum_f |x(f + s) - x(f) - (a + b f)|^2 / sum_f |x(f) - (a' + b' f)|^2
///
/// over these samples f, each with its best straight line: the local autocorrelation of the motion
/// about its drift. A lag is used only if span and surroundings are observed throughout. Best
/// first, none worse than 1.5 times the best.
std::vector<Cycle> find_cycles(const Track& track, FrameSpan span, const CurveSettings& settings,
                               const CycleSettings& rules = {});

/// Fills the span with the mean of these cycles (one at least), weighted by similarity and moved so
/// that it meets the samples at its ends in value and velocity (`place_guess`).
void fill_with_cycles(Track& track, FrameSpan span, std::span<const Cycle> cycles,
                      const CurveSettings& settings);

/// Finds cycles and fills the span with them. Returns false and writes nothing if fewer than
/// `least_cycles` (at least 1) are found.
bool fill_by_cycles(Track& track, FrameSpan span, const CurveSettings& settings,
                    std::size_t least_cycles);

}  // namespace kinemend::fill
