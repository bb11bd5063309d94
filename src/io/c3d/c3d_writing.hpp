// The two ways to write a C3D file: into the bytes of its source, or as a new file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

/// Returns a C3D file of Intel reals. `origin`: the source file of the clip, if any. Its parameters
/// are kept if they are still valid; `C3dCarried` decides which of its analog samples and cameras
/// are kept. Errors: `usage` for names longer than 255 bytes, more than 65,535 markers, and
/// positions too large for a real.
std::string new_c3d(const Take& clip, const C3dOrigin& origin);

/// Values for the parameters of a new file besides the clip's names, events, rate and units.
struct C3dNewFile {
  std::size_t frame_count = 0;
  double scale = 0;                 ///< > 0: resolution of residuals, and of integers made from it
  std::size_t analog_count = 0;     ///< channels; 0 removes the source's parameters of analog data
  std::size_t analog_instants = 0;  ///< per frame
};

/// Returns the parameters of a new file of reals. `origin`: the source file of the clip, if any.
/// Its parameters that do not describe the clip are kept; places and lengths (force plates, the
/// axes of the screen) are converted with the clip. POINT:DATA_START exists but is 0.
C3dParameters new_c3d_parameters(const Take& clip, const C3dOrigin& origin, const C3dNewFile& file);

bool same_c3d_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b);

/// Whether the clip differs from its document in samples and rate only.
bool keeps_c3d_layout(const Take& clip, const C3dDocument& document);

/// Returns the document's bytes with every changed sample replaced, for a clip that keeps its
/// layout; empty if a sample does not fit into the document's integers.
std::optional<std::string> rewrite_c3d(const Take& clip, const C3dDocument& document);

}  // namespace kinemend
