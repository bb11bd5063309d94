// Keeps a glTF file as it was read so that it can be written back in place.
#pragma once

#include <string_view>

#include "io/gltf/gltf_data.hpp"
#include "io/gltf/gltf_motion.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A glTF file as it was read, and the animation of the take.
struct GltfDocument : SourceDocument {
  GltfFile file;
  GltfModel model;
  GltfBuffers buffers;
  std::size_t animation = GltfTrack::none;
  bool has_markers = false;
  double rate_hz = 0;  ///< requested rate for keys that are not on a grid of frames

  /// Decodes the motion again, with the same numbers.
  GltfMotion motion() const {
    GltfBuffers loaded = buffers;
    return has_markers ? decode_gltf_markers(file, model, loaded, animation, rate_hz)
                       : decode_gltf_joints(file, model, loaded, animation, rate_hz);
  }
};

}  // namespace kinemend
