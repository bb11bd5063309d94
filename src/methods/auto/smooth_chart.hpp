// Converts a track of rotations to vectors about a smoothed copy of the track.
#pragma once

#include <span>

#include "methods/auto/tuning.hpp"
#include "motion/rotation_chart.hpp"

namespace kinemend {

/// The chart of a track without gross spikes. Its reference is the track's Gaussian mean, cut at
/// 2.5 deviations and symmetrically at the ends of the take; path[0] = 0. The signs of the
/// quaternions do not matter.
RotationChart smooth_chart(std::span<const Quat> track, double frame_rate_hz,
                           const ChartTuning& tuning = {});

}  // namespace kinemend
