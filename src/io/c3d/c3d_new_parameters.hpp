// Makes the parameters of a new C3D file.
#pragma once

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

/// What the parameters of a new file have to say beside the clip's own names, events, rate and
/// units.
struct C3dNewFile {
  std::size_t frame_count = 0;
  double scale = 0;                 ///< > 0: resolution of residuals, and of integers made from it
  std::size_t analog_count = 0;     ///< channels; 0 takes what a source says of analog data away
  std::size_t analog_instants = 0;  ///< of a frame
};

/// Parameters of a new file of reals. `origin`: the file the clip comes from, if any; what it says
/// of other things than the clip is kept, and what it says of places and lengths follows the clip:
/// force plates, the axes of the screen. POINT:DATA_START is there, but 0.
C3dParameters new_c3d_parameters(const Take& clip, const C3dOrigin& origin, const C3dNewFile& file);

}  // namespace kinemend
