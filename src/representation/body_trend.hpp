#pragma once

#include <span>
#include <vector>

namespace kinemend::representation {

/// The slow part of a track: a short running median, so that spikes do not move it, then at each
/// frame the straight line fitted with Gaussian weights of standard deviation `deviation_s` (cut at
/// three of them), so that steady motion stays as it is, also at the ends. `weights`: one a frame,
/// how well the sample is known; where all are 0 the track is held or bridged in a straight line.
/// Cost grows linearly with length.
std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s);

/// Angles (radians) continued from frame to frame; samples of weight 0 are passed over, and a few
/// that are thrown far off do not turn what follows by a whole turn.
void continue_angles(std::span<double> angles, std::span<const double> weights);

}  // namespace kinemend::representation
