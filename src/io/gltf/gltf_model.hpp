// Holds the parts of a glTF file that motion needs, as plain data, and decomposes the matrices of
// nodes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/gltf_container.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

struct GltfBuffer {
  enum class Place : std::uint8_t { binary_chunk, in_text, beside, unknown };
  std::size_t size = 0;
  Place place = Place::unknown;
  std::string uri;   ///< address of a separate file, as the text spells it
  std::string path;  ///< decoded relative path of `uri`; empty if it is refused
};

struct GltfView {
  std::size_t buffer = 0, offset = 0, size = 0;
  std::size_t stride = 0;  ///< 0: elements follow each other
  std::string coded;       ///< the extension that compresses it; usually empty
};

/// The numbers that glTF 2.0 uses for the types of components (section 3.6.2.2), from OpenGL.
inline constexpr int gltf_byte = 5120, gltf_ubyte = 5121, gltf_short = 5122, gltf_ushort = 5123,
                     gltf_uint = 5125, gltf_float = 5126;

/// Numbers of a sparse accessor that replace those of its view.
struct GltfSparse {
  std::size_t count = 0;
  std::size_t index_view = 0, index_offset = 0;
  int index_component = 0;
  std::size_t value_view = 0, value_offset = 0;
};

struct GltfAccessor {
  std::optional<std::size_t> view;
  std::size_t offset = 0, count = 0;
  int component = 0;      ///< `gltf_byte` to `gltf_float`
  std::size_t width = 0;  ///< components of an element; 0: of an unknown type
  bool normalized = false;
  bool has_range = false;  ///< min or max is stated
  std::optional<GltfSparse> sparse;
};

struct GltfNode {
  std::string name;
  std::vector<std::uint32_t> children;
  std::int64_t parent = -1;
  Vec3 translation;
  Quat rotation;
  Vec3 scale{1, 1, 1};
  bool has_matrix = false;
  bool is_sheared = false;  ///< its matrix is not a product of translation, rotation and scale
  bool holds_more = false;  ///< a mesh, a camera or a light
};

enum class GltfPath : std::uint8_t { translation, rotation, scale, other };
enum class GltfInterpolation : std::uint8_t { step, linear, cubic_spline };

struct GltfSampler {
  std::size_t input = 0, output = 0;
  GltfInterpolation interpolation = GltfInterpolation::linear;
};

struct GltfChannel {
  std::size_t sampler = 0;
  std::int64_t node = -1;
  GltfPath path = GltfPath::other;
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfSampler> samplers;
  std::vector<GltfChannel> channels;
};

struct GltfModel {
  std::vector<GltfBuffer> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfNode> nodes;
  std::vector<std::size_t> roots;  ///< nodes without a parent; nodes of the scene first
  std::vector<std::vector<std::size_t>> skins;  ///< the joints of each skin
  std::vector<GltfAnimation> animations;
  std::vector<std::size_t> used_elsewhere;  ///< accessors of meshes and skins
  std::vector<std::size_t> image_views;
  std::vector<std::string> image_paths;  ///< relative paths of separate image files
  std::size_t meshes = 0;
  std::string generator;
};

/// Parses the JSON and checks the fields that motion needs: types, indices, one parent per node and
/// no cycles. Offsets and sizes are checked where data is read. Errors: `unreadable_input` with the
/// byte.
GltfModel parse_gltf(const GltfFile& file);

/// Returns a name for messages and joints: the node's own, else `node_3`.
std::string name_of_node(const GltfModel& model, std::size_t node);
/// Returns the name of an animation; `#2` for the second one if it has no name.
std::string name_of_animation(const GltfModel& model, std::size_t animation);

struct GltfPlacement {
  Vec3 translation;
  Quat rotation;
  Vec3 scale{1, 1, 1};      ///< all negative if the matrix mirrors
  bool is_sheared = false;  ///< the product of the parts differs from the matrix
};

/// Decomposes 16 numbers, column by column.
GltfPlacement placement_of_matrix(std::span<const double> matrix);

/// Returns the nearest rotation of a quaternion as written; identity for zero.
Quat unit_rotation_of_any(Quat q);
inline Quat unit_rotation(Quat q) {
  const double square = dot(q, q);
  // Within these limits the square neither overflows nor loses digits.
  if (square > 1e-3 && square < 1e3) return (1 / std::sqrt(square)) * q;
  return unit_rotation_of_any(q);
}

/// Returns the product by components.
inline Vec3 scaled(Vec3 scale, Vec3 v) { return {scale.x * v.x, scale.y * v.y, scale.z * v.z}; }

}  // namespace kinemend
