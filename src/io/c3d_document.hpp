#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/c3d_layout.hpp"
#include "io/c3d_parameters.hpp"
#include "io/marker_zeros.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// A C3D file as it was read. The bytes hold every sample, so beside them only what tells where
/// they stand is kept, and what the clip was made with: a rewrite decodes the samples again, which
/// is quicker than to store them twice.
struct C3dDocument : SourceDocument {
  std::string bytes;
  C3dProcessor processor = C3dProcessor::intel;
  C3dLayout layout;
  C3dParameters parameters;
  std::vector<ZeroGap> zero_gaps;
  std::vector<std::string> names;  ///< of the clip, as are the next three
  std::string unit;
  double frame_rate_hz = 0;
  std::vector<MarkerEvent> events;
};

}  // namespace kinemend
