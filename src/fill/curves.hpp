// Curves through a track's own samples, and guesses moved to meet the ends of a gap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fill/track.hpp"

namespace kinemend::fill {

enum class Curve : std::uint8_t {
  linear,
  cubic,             ///< natural cubic spline through the samples around the gap
  quintic,           ///< quintic smoothing spline, smoothed as their noise demands (Woltring 1986)
  shape_preserving,  ///< PCHIP: no overshoot (Fritsch & Carlson 1980, Fritsch & Butland 1984)
  hermite            ///< cubic between robust velocities at both ends, straight far from them
};

/// The velocity settings (of `velocity_window_s` and `reach_s` on) were chosen on the takes that
/// docs/methods/fill.md names; the supports and cutoffs are not swept.
struct CurveSettings {
  double frame_rate_hz = 0;
  double support_s = 0.5;           ///< of the splines: samples used on either side, 48 at least
  double least_cutoff_hz = 3;       ///< of `quintic`: cross-validation smooths between these two;
  double most_cutoff_hz = 6;        ///< less would throw the curve where noise is not white
  double velocity_window_s = 0.06;  ///< of end velocities, 5 samples at least
  double reach_s = 0.25;            ///< of `hermite`: end velocities fade so far into the gap
  double blend_s = 0.1;             ///< of `place_guess`: a miss in velocity fades so far
  double decay_s = 0.15;            ///< an end velocity that nothing continues fades so fast
};

/// Fills the span on the curve, which meets the samples at its ends in value and velocity (`linear`
/// in value). At the take's start or end, where only one side is observed, the value goes on with
/// the end's velocity, which decays (`linear`: is held). False, and nothing is written, where no
/// sample of the track is observed.
bool fill_with_curve(Track& track, FrameSpan span, Curve curve, const CurveSettings& settings);

/// A guess of a span, such as a regression makes it, with some frames around it.
struct Guess {
  std::size_t first_frame = 0;
  std::vector<Vec3> values;  ///< from `first_frame` on; at least the span
};

/// Writes the guess into the span, moved so that it meets the samples at the ends in value and
/// velocity: its difference from them goes over linearly from end to end, the difference in
/// velocity fades within `blend_s`. The guess has to cover the observed frames next to the span,
/// about `velocity_window_s` of them on either side; a side it does not cover is not met.
void place_guess(Track& track, FrameSpan span, const Guess& guess, const CurveSettings& settings);

/// Value and velocity (per frame) at one end of a span.
struct EndState {
  bool known = false;
  Vec3 value;     ///< of the end's own sample
  Vec3 velocity;  ///< of a line through the samples near it, outliers aside
};

/// The state at the last observed frame before the span, and at the first one behind it.
EndState state_before(const Track& track, FrameSpan span, const CurveSettings& settings);
EndState state_behind(const Track& track, FrameSpan span, const CurveSettings& settings);

/// Frames that an end's velocity is taken from.
std::size_t velocity_window(const CurveSettings& settings);

}  // namespace kinemend::fill
