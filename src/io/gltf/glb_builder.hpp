// Builds a binary glTF file from nodes, arrays, meshes and animations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend {

using Json = nlohmann::ordered_json;

/// A binary glTF 2.0 file under construction: a JSON document, and the bytes that its accessors
/// point to.
class GlbBuilder {
 public:
  GlbBuilder();

  Json& document() { return document_; }

  /// Appends a node and returns its index, like the functions below.
  std::size_t add_node(Json node);
  /// Appends elements of `components` floats: 1, 3, 4 or 16. `with_range` adds the least and
  /// largest value of each component, which times and vertex positions must have.
  std::size_t add_floats(const std::vector<float>& values, std::size_t components, bool with_range,
                         bool of_vertices);
  /// Appends four joint indices per vertex.
  std::size_t add_vertex_joints(const std::vector<std::uint16_t>& values);

  /// Returns the file's bytes. Bytes of names that are not UTF-8 are removed.
  std::string finish() &&;

 private:
  std::size_t add_view(const void* data, std::size_t bytes, bool of_vertices);
  std::size_t add_accessor(std::size_t view, int component_type, std::size_t count,
                           const char* type);

  Json document_;
  std::string binary_;
};

/// One animation of nodes with the same times.
class GlbAnimation {
 public:
  /// Frame f has the time f / rate. At least one frame.
  GlbAnimation(GlbBuilder& file, std::size_t frames, double frame_rate_hz);

  void add_translation(std::size_t node, const std::vector<float>& xyz);
  /// Adds rotations with signs chosen so that interpolation takes the shortest path.
  void add_rotation(std::size_t node, std::vector<Quat> rotations);
  /// Adds steps in which the node is visible (1) or not (0).
  void add_presence(std::size_t node, const std::vector<std::uint8_t>& present);
  void finish();

 private:
  void add_channel(std::size_t node, const char* path, std::size_t output,
                   const char* interpolation);

  GlbBuilder& file_;
  std::size_t times_;
  Json samplers_ = Json::array();
  Json channels_ = Json::array();
};

/// Triangles with one normal each.
struct GlbMesh {
  std::vector<float> positions, normals;  ///< three per vertex, three vertices per triangle
  std::vector<std::uint16_t> joints;      ///< joint of each vertex; empty without skin

  void add_triangle(const std::array<Vec3, 3>& corners, Vec3 inside, std::uint16_t joint);
  std::size_t vertices() const { return positions.size() / 3; }
};

/// Adds mesh and material; returns the mesh's index.
std::size_t add_mesh(GlbBuilder& file, const GlbMesh& mesh, const char* name);

/// Converts to floats. Errors: `usage` for a number that overflows as a float, which glTF cannot
/// hold.
std::array<float, 3> to_floats(Vec3 v);

}  // namespace kinemend
