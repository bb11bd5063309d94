// Finds the frames of an animation from its keys.
#pragma once

#include <vector>

#include "io/gltf/gltf_curve.hpp"

namespace kinemend {

struct GltfGrid {
  GltfTimes times;
  bool is_of_keys = true;  ///< every key of a moving channel lies on a frame
  /// The keys do not define a rate, because there are fewer than two times.
  bool is_assumed = false;
};

/// Returns the coarsest grid of frames that contains all keys of the curves: the keys' own spacing
/// if they are evenly spaced (half of the frames may lack keys), else a usual rate. Keys may
/// deviate by a tenth of a frame and a millisecond, because decimals and single precision round
/// them. Without such a grid the rate is `rate_hz`, or 30 Hz if it is 0. Constant curves are used
/// only if all curves are constant.
GltfGrid grid_of_curves(const std::vector<const GltfCurve*>& curves, double rate_hz);

}  // namespace kinemend
