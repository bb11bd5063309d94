// Curves through a track's own samples, cycles of its motion, and guesses moved to meet the ends of
// a gap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/track.hpp"

namespace kinemend::fill {

enum class Curve : std::uint8_t {
  linear,
  cubic,             ///< natural cubic spline through the samples around the gap
  quintic,           ///< quintic smoothing spline, smoothed as the noise requires (Woltring 1986)
  shape_preserving,  ///< PCHIP: no overshoot (Fritsch & Carlson 1980, Fritsch & Butland 1984)
  hermite            ///< cubic between robust velocities at both ends, straight far from them
};

/// The velocity settings (`velocity_window_s`, `reach_s` and those below) were chosen on the takes
/// that docs/measured/fill.md names; the supports and cutoffs are not swept.
struct CurveSettings {
  double frame_rate_hz = 0;
  double support_s = 0.5;           ///< samples that splines use on either side, 48 at least
  double least_cutoff_hz = 3;       ///< `quintic`: bounds within which cross-validation
  double most_cutoff_hz = 6;        ///< smooths; less would overshoot on coloured noise
  double velocity_window_s = 0.06;  ///< samples that give an end velocity, 5 at least
  double reach_s = 0.25;            ///< `hermite`: end velocities fade over this time into the gap
  double blend_s = 0.1;             ///< `place_guess`: a velocity difference fades over this time
  double decay_s = 0.15;            ///< decay of an end velocity where only one end is observed
};

/// Fills the span on the curve, which meets the samples at its ends in value and velocity
/// (`linear`: in value only). At the take's start or end, where only one side is observed, the
/// curve continues with that end's velocity, which decays (`linear`: holds the value). Returns
/// false and writes nothing if no sample of the track is observed.
bool fill_with_curve(Track& track, FrameSpan span, Curve curve, const CurveSettings& settings);

/// A guess of a span, for example by a regression, with some frames around it.
struct Guess {
  std::size_t first_frame = 0;
  std::vector<Vec3> values;  ///< from `first_frame` on; at least the span
};

/// Writes the guess into the span, moved so that it meets the samples at the ends in value and
/// velocity: the offset from the samples is interpolated linearly from end to end, and the velocity
/// difference fades within `blend_s`. The guess must cover about `velocity_window_s` of observed
/// frames next to the span on either side; a side it does not cover is not met.
void place_guess(Track& track, FrameSpan span, const Guess& guess, const CurveSettings& settings);

/// Value and velocity (per frame) at one end of a span.
struct EndState {
  bool known = false;
  Vec3 value;     ///< of the end's own sample
  Vec3 velocity;  ///< slope of a robust line through the samples near it
};

/// The state at the last observed frame before the span, and at the first one after it.
EndState state_before(const Track& track, FrameSpan span, const CurveSettings& settings);
EndState state_behind(const Track& track, FrameSpan span, const CurveSettings& settings);

/// Returns the number of frames that give an end velocity.
std::size_t velocity_window(const CurveSettings& settings);

/// Another time of the take at which a track moves as it does around a span.
struct Cycle {
  std::ptrdiff_t lag = 0;  ///< frame f of the span resembles frame f + lag
  /// Difference of the surroundings: 0 identical, 1 no better than a straight line.
  double mismatch = 0;
};

/// The lags at which the samples around the span (half its length on either side, 0.15 to 0.5 s)
/// repeat best: local minima of
///
///     m(s)^2 = sum_f |x(f + s) - x(f) - (a + b f)|^2 / sum_f |x(f) - (a' + b' f)|^2
///
/// over these samples f, each with its best straight line: the local autocorrelation of the motion
/// about its drift. A lag is used only if span and surroundings are observed throughout. Best
/// first, none worse than 1.5 times the best.
std::vector<Cycle> find_cycles(const Track& track, FrameSpan span, const CurveSettings& settings);

/// Finds cycles and fills the span with their mean, weighted by similarity and moved so that it
/// meets the samples at its ends in value and velocity (`place_guess`). Returns false and writes
/// nothing if fewer than `least_cycles` (at least 1) are found.
bool fill_by_cycles(Track& track, FrameSpan span, const CurveSettings& settings,
                    std::size_t least_cycles);

}  // namespace kinemend::fill
