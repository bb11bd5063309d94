// The slow part of a track: the trend of heading and place that a body's frame follows.
#pragma once

#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend::representation {

/// The slow part of a track: a running median over a tenth of a second (five frames at least), so
/// that spikes do not move it, then at each frame the parabola fitted with Gaussian weights of
/// standard deviation `deviation_s` (cut at three of them), so that curves are hardly cut; towards
/// the ends it becomes the straight line, so that steady motion stays as it is, and noise is not
/// amplified. `weights`: one a frame, how well the sample is known; where all are 0 the
/// track is held or bridged in a straight line. Cost grows linearly with length.
std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s);

/// The same of x and z of a path; y becomes 0. The median is the sample with the least sum of
/// distances to those around it, so that it does not matter how the axes are turned.
std::vector<Vec3> smooth_path(std::vector<Vec3> path, std::span<const double> weights,
                              double frame_rate_hz, double deviation_s);

/// Angles (radians) continued from frame to frame; samples of weight 0 are passed over, and a few
/// that are thrown far off do not turn what follows by a whole turn.
void continue_angles(std::span<double> angles, std::span<const double> weights);

}  // namespace kinemend::representation
