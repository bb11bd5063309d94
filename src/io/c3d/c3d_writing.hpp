// The two ways in which a C3D file is written: into the bytes of its source, or anew.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

/// A C3D file of Intel reals. `origin`: the file the clip comes from, if any, whose parameters are
/// kept as far as they still hold, and its analog samples and cameras as far as `C3dCarried` says.
/// Errors: `usage` for names longer than 255 bytes, more than 65,535 markers, and positions too
/// large for a real.
std::string new_c3d(const Take& clip, const C3dOrigin& origin);

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

bool same_c3d_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b);

/// Whether the clip differs from its document in samples and rate only.
bool keeps_c3d_layout(const Take& clip, const C3dDocument& document);

/// The document's own bytes with every changed sample replaced, for a clip that keeps its layout.
/// Nothing where a sample does not fit into the document's integers.
std::optional<std::string> rewrite_c3d(const Take& clip, const C3dDocument& document);

}  // namespace kinemend
