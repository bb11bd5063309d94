// Decodes the nodes and the animation of a glTF file as a take, records the source of each value,
// and keeps the file so that it can be written back in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/gltf_curve.hpp"
#include "io/gltf/gltf_data.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The rotation or the position of a take's joint or marker, and its node in the file.
struct GltfTrack {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t owner = 0;  ///< a rotation: the joint; a position: the point of the take
  std::size_t node = 0;
  GltfPath path = GltfPath::rotation;
  std::size_t channel = none;  ///< index in the animation; `none`: the node has no such channel
  bool has_key_each_frame = false;
  /// A rotation of the file is `rest` times the take's rotation.
  Quat rest;
  /// A position of the take is origin + outer (scale x translation); `scale` has one value per
  /// frame, or one for all.
  Quat outer;
  Vec3 origin;
  std::vector<Vec3> scale = std::vector<Vec3>(1, Vec3{1, 1, 1});

  Vec3 scale_at(std::size_t frame) const { return scale[std::min(frame, scale.size() - 1)]; }
  Vec3 to_take(Vec3 translation, std::size_t frame) const;
  /// Converts a position to the file. Errors: `usage` if the scale is 0, so that no value moves the
  /// joint.
  Vec3 to_file(Vec3 position, std::size_t frame, const std::string& name) const;
};

/// A take and the origin of its values.
struct GltfMotion {
  Take take;
  GltfGrid grid;
  std::size_t animation = GltfTrack::none;  ///< `none`: the file has no motion
  std::vector<GltfTrack> tracks;
  std::vector<std::string> odd_scales;  ///< nodes whose scale a take cannot express
  std::vector<std::string> sheared;     ///< nodes whose matrix was sheared
  std::vector<std::string> repeated;    ///< nodes with two channels of one kind
  std::size_t interpolated = 0;         ///< moving channels without a key in each frame
  std::size_t held_keys = 0;            ///< keys that are not finite
};

/// Returns the nodes that are joints, in tree order: the joints of the skins, and animated nodes
/// above or below them; without a skin, the nodes that the animation moves. Static nodes above a
/// root are not joints. Nodes between joints are.
std::vector<std::size_t> gltf_joints(const GltfModel& model, std::size_t animation);

/// Decodes the animation `animation` (`none`: a take without frames) as a take of joints, or of
/// markers for a file of markers from `write_glb`: children of a node called "markers", moved but
/// not rotated. `rate_hz`: for keys that are not on a grid of frames. The same file always gives
/// the same numbers. Errors: `unreadable_input`.
GltfMotion decode_gltf(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                       std::size_t animation, double rate_hz);

/// A glTF file as it was read, and the animation of the take.
struct GltfDocument : SourceDocument {
  GltfFile file;
  GltfModel model;
  GltfBuffers buffers;
  std::size_t animation = GltfTrack::none;
  double rate_hz = 0;  ///< requested rate for keys that are not on a grid of frames

  /// Decodes the motion again, with the same numbers.
  GltfMotion motion() const {
    GltfBuffers loaded = buffers;
    return decode_gltf(file, model, loaded, animation, rate_hz);
  }
};

}  // namespace kinemend
