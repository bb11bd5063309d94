// Finds the frames that the keys of an animation stand for.
#pragma once

#include <vector>

#include "io/gltf/gltf_curve.hpp"

namespace kinemend {

struct GltfGrid {
  GltfTimes times;
  bool is_of_keys = true;   ///< every key of a moving channel lies on a frame
  bool is_assumed = false;  ///< the keys do not say a rate: there are fewer than two times
};

/// The coarsest frames on which all keys of the curves lie: those of the keys themselves where they
/// are evenly spaced (half of the frames may lack keys), else one of the usual rates. Keys may be
/// off by a tenth of a frame and a millisecond, as decimals and single precision round them. Where
/// there are no such frames: `rate_hz`, or 30 Hz where it is 0. A curve that never changes counts
/// only where all are so.
GltfGrid grid_of_curves(const std::vector<const GltfCurve*>& curves, double rate_hz);

}  // namespace kinemend
