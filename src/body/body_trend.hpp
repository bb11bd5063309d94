// The trend of heading and place that a body's frame follows.
#pragma once

#include <span>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend::representation {

/// Returns the slow part of a track. A running median over a tenth of a second (five frames at
/// least) removes spikes; then at each frame a parabola is fitted with Gaussian weights of standard
/// deviation `deviation_s` (cut at three of them), which hardly flattens curves. Towards the ends
/// it becomes a straight line, which keeps steady motion and does not amplify noise. `weights`: the
/// certainty of each frame's sample; where all are 0 the track is held or bridged by a straight
/// line. Cost grows linearly with length.
std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s);

/// Returns the trend of x and z of a path; y becomes 0. The median is the sample with the least sum
/// of distances to the others, so that the orientation of the axes does not matter.
std::vector<Vec3> smooth_path(std::vector<Vec3> path, std::span<const double> weights,
                              double frame_rate_hz, double deviation_s);

/// Continues angles (radians) from frame to frame. Samples of weight 0 are skipped, and a few
/// outliers do not shift later angles by a whole turn.
void continue_angles(std::span<double> angles, std::span<const double> weights);

}  // namespace kinemend::representation
