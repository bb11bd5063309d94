// Makes new files, skeletons as skinned bones and markers as small spheres, and lays out their JSON
// and binary data.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/gltf.hpp"
#include "io/gltf/gltf_container.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/held_samples.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

namespace {

using Json = nlohmann::ordered_json;

// A number that is finite as a double may overflow as a float, which glTF cannot hold.
void check_finite(std::span<const float> values) {
  if (std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    return;
  throw Error(ErrorKind::usage, "a length is too large for a glTF file");
}

std::array<float, 3> to_floats(Vec3 v) {
  const std::array<float, 3> floats{static_cast<float>(v.x), static_cast<float>(v.y),
                                    static_cast<float>(v.z)};
  check_finite(floats);
  return floats;
}

Json json_of(Vec3 v) { return to_floats(v); }

Json json_of(Quat q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
          static_cast<float>(q.w)};
}

void append(std::vector<float>& values, Vec3 v) {
  const auto floats = to_floats(v);
  values.insert(values.end(), floats.begin(), floats.end());
}

// A binary glTF 2.0 file under construction: a JSON document, and the bytes that its accessors
// point to.
class GlbBuilder {
 public:
  GlbBuilder() {
    static_assert(std::endian::native == std::endian::little, "glTF holds little-endian numbers");
    document_["asset"] = {{"version", "2.0"}, {"generator", "Kinemend " + std::string(version())}};
    document_["scene"] = 0;
    document_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    document_["nodes"] = Json::array();
  }

  Json& document() { return document_; }

  // Appends a node and returns its index, like the functions below.
  std::size_t add_node(Json node) {
    document_["nodes"].push_back(std::move(node));
    return document_["nodes"].size() - 1;
  }
  void show(std::size_t node) { document_["scenes"][0]["nodes"].push_back(node); }

  // Appends elements of `components` floats: 1, 3, 4 or 16. `with_range` adds the least and largest
  // value of each component, which times and vertex positions must have.
  std::size_t add_floats(const std::vector<float>& values, std::size_t components,
                         bool with_range = false, bool of_vertices = false) {
    check_finite(values);
    const std::size_t index = add_accessor(std::as_bytes(std::span(values)), of_vertices,
                                           gltf_float, values.size() / components, components);
    if (with_range) {
      std::vector<float> least(values.begin(),
                               values.begin() + static_cast<std::ptrdiff_t>(components));
      std::vector<float> most = least;
      for (std::size_t i = 0; i < values.size(); ++i) {
        least[i % components] = std::min(least[i % components], values[i]);
        most[i % components] = std::max(most[i % components], values[i]);
      }
      document_["accessors"][index]["min"] = least;
      document_["accessors"][index]["max"] = most;
    }
    return index;
  }
  // Appends four joint indices per vertex.
  std::size_t add_vertex_joints(const std::vector<std::uint16_t>& values) {
    return add_accessor(std::as_bytes(std::span(values)), true, gltf_ushort, values.size() / 4, 4);
  }

  // Returns the file's bytes. Bytes of names that are not UTF-8 are removed.
  std::string finish() && {
    pad();
    if (!binary_.empty()) document_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return new_glb(document_.dump(-1, ' ', false, Json::error_handler_t::ignore), binary_);
  }

 private:
  void pad() { binary_.append((4 - binary_.size() % 4) % 4, '\0'); }

  std::size_t add_accessor(std::span<const std::byte> bytes, bool of_vertices, int component_type,
                           std::size_t count, std::size_t components) {
    constexpr int target_array_buffer = 34962;
    pad();
    Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (of_vertices) view["target"] = target_array_buffer;
    binary_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    document_["bufferViews"].push_back(std::move(view));
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", component_type},
                                      {"count", count},
                                      {"type", gltf_type_of_width(components)}});
    return document_["accessors"].size() - 1;
  }

  Json document_;
  std::string binary_;
};

// One animation of nodes with the same times.
class GlbAnimation {
 public:
  // Frame f has the time f / rate. At least one frame.
  GlbAnimation(GlbBuilder& file, std::size_t frames, double frame_rate_hz) : file_(file) {
    std::vector<float> times(frames);
    for (std::size_t f = 0; f < frames; ++f)
      times[f] = static_cast<float>(static_cast<double>(f) / frame_rate_hz);
    times_ = file_.add_floats(times, 1, true);
  }

  void add_translation(std::size_t node, const std::vector<float>& xyz) {
    add_channel(node, "translation", file_.add_floats(xyz, 3), "LINEAR");
  }
  // Adds rotations with signs chosen so that interpolation takes the shortest path.
  void add_rotation(std::size_t node, std::vector<Quat> rotations) {
    align_hemispheres(rotations);
    std::vector<float> xyzw;
    xyzw.reserve(4 * rotations.size());
    for (const Quat& q : rotations) {
      for (const double value : {q.x, q.y, q.z, q.w}) xyzw.push_back(static_cast<float>(value));
    }
    add_channel(node, "rotation", file_.add_floats(xyzw, 4), "LINEAR");
  }
  // Adds steps in which the node is visible (1) or not (0).
  void add_presence(std::size_t node, const std::vector<std::uint8_t>& present) {
    std::vector<float> scales;
    for (const std::uint8_t there : present)
      scales.insert(scales.end(), 3, there != 0 ? 1.0F : 0.0F);
    add_channel(node, "scale", file_.add_floats(scales, 3), "STEP");
  }
  void finish() {
    if (channels_.empty()) return;
    file_.document()["animations"] = Json::array({{{"name", "take"},
                                                   {"samplers", std::move(samplers_)},
                                                   {"channels", std::move(channels_)}}});
  }

 private:
  void add_channel(std::size_t node, const char* path, std::size_t output,
                   const char* interpolation) {
    samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", interpolation}});
    channels_.push_back(
        {{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  GlbBuilder& file_;
  std::size_t times_;
  Json samplers_ = Json::array();
  Json channels_ = Json::array();
};

// Triangles with one normal each.
struct GlbMesh {
  std::vector<float> positions, normals;  // three per vertex, three vertices per triangle
  std::vector<std::uint16_t> joints;      // joint of each vertex; empty without skin

  void add_triangle(const std::array<Vec3, 3>& corners, Vec3 inside, std::uint16_t joint) {
    std::array<Vec3, 3> c = corners;
    Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
    if (dot(normal, c[0] - inside) < 0) {
      std::swap(c[1], c[2]);
      normal = -normal;
    }
    const double length = norm(normal);
    if (!(length > 0)) return;
    const Vec3 direction = (1 / length) * normal;
    for (const Vec3& corner : c) {
      append(positions, corner);
      append(normals, direction);
      joints.push_back(joint);
    }
  }
};

// Adds mesh and material; returns the mesh's index.
std::size_t add_mesh(GlbBuilder& file, const GlbMesh& mesh, const char* name) {
  file.document()["materials"] = Json::array({{{"name", name},
                                               {"pbrMetallicRoughness",
                                                {{"baseColorFactor", {0.85, 0.55, 0.2, 1}},
                                                 {"metallicFactor", 0},
                                                 {"roughnessFactor", 0.7}}}}});
  Json attributes{{"POSITION", file.add_floats(mesh.positions, 3, true, true)},
                  {"NORMAL", file.add_floats(mesh.normals, 3, false, true)}};
  if (!mesh.joints.empty()) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (const std::uint16_t joint : mesh.joints) {
      joints.insert(joints.end(), {joint, 0, 0, 0});
      weights.insert(weights.end(), {1, 0, 0, 0});
    }
    attributes["JOINTS_0"] = file.add_vertex_joints(joints);
    attributes["WEIGHTS_0"] = file.add_floats(weights, 4, false, true);
  }
  file.document()["meshes"].push_back(
      {{"name", name},
       {"primitives", Json::array({{{"attributes", attributes}, {"material", 0}}})}});
  return file.document()["meshes"].size() - 1;
}

// Adds a bone as a double pyramid, thickest at a tenth of its length.
void add_bone(GlbMesh& mesh, Vec3 from, Vec3 to, std::uint16_t joint) {
  const Vec3 along = to - from;
  const Vec3 other = std::fabs(along.x) < 0.5 * norm(along) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 side = cross(along, other);
  const double length = norm(along), radius = 0.06 * length;
  const Vec3 u = (radius / norm(side)) * side, v = (1 / length) * cross(along, u);
  const Vec3 waist = from + 0.1 * along;
  const Vec3 ring[4] = {waist + u, waist + v, waist - u, waist - v};
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.add_triangle({from, ring[i], ring[(i + 1) % 4]}, waist, joint);
    mesh.add_triangle({to, ring[i], ring[(i + 1) % 4]}, waist, joint);
  }
}

// Adds an octahedron whose faces are divided by four `cuts` times and projected on the sphere.
void add_sphere(GlbMesh& mesh, double radius, int cuts) {
  const auto out = [&](Vec3 v) { return (radius / norm(v)) * v; };
  const auto cut = [&](auto&& self, std::array<Vec3, 3> c, int left) -> void {
    if (left == 0) return mesh.add_triangle(c, {}, 0);
    const Vec3 ab = out(c[0] + c[1]), bc = out(c[1] + c[2]), ca = out(c[2] + c[0]);
    for (const auto& part :
         {std::array{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {ab, bc, ca}})
      self(self, part, left - 1);
  };
  for (const double x : {-radius, radius}) {
    for (const double y : {-radius, radius}) {
      for (const double z : {-radius, radius})
        cut(cut, {Vec3{x, 0, 0}, {0, y, 0}, {0, 0, z}}, cuts);
    }
  }
  mesh.joints.clear();
}

class SkeletonWriter {
 public:
  explicit SkeletonWriter(const Take& clip, std::span<const NamedCurve> curves)
      : clip_(clip),
        skeleton_(clip.skeleton),
        curves_(curves),
        scale_(likely_metres_per_unit(clip)) {
    if (!(scale_ > 0)) scale_ = 1;
  }

  std::string write() {
    add_nodes();
    add_animation();
    add_curves();
    if (clip_.joint_count() > 0) add_skin();
    return std::move(file_).finish();
  }

 private:
  // Joint j is node j; end sites follow, then the parent node of all.
  void add_nodes() {
    std::vector<Json> nodes;
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) {
      nodes.push_back({{"name", skeleton_.names[j]},
                       {"translation", json_of(scale_ * skeleton_.offsets[j])},
                       {"rotation", json_of(skeleton_.rest_rotations[j])}});
    }
    Json roots = Json::array();
    const auto hang = [&](std::size_t node, std::int32_t parent) {
      (parent < 0 ? roots : nodes[static_cast<std::size_t>(parent)]["children"]).push_back(node);
    };
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) hang(j, skeleton_.parents[j]);
    for (const EndSite& site : skeleton_.end_sites) {
      const std::string& parent = skeleton_.names[static_cast<std::size_t>(site.parent)];
      hang(nodes.size(), site.parent);
      nodes.push_back({{"name", site.name.empty() ? parent + "_end" : site.name},
                       {"translation", json_of(scale_ * site.offset)}});
    }
    for (Json& node : nodes) file_.add_node(std::move(node));
    Json armature{{"name", "skeleton"}};
    if (!roots.empty()) armature["children"] = std::move(roots);
    armature_ = file_.add_node(std::move(armature));
    file_.show(armature_);
  }

  void add_animation() {
    const std::size_t frames = clip_.frame_count(), joints = clip_.joint_count();
    if (frames == 0) return;
    GlbAnimation animation(file_, frames, clip_.frame_rate_hz);
    for (std::size_t j = 0; j < joints; ++j) {
      std::vector<Quat> rotations(frames);
      for (std::size_t f = 0; f < frames; ++f)
        rotations[f] = normalized(skeleton_.rest_rotations[j] * clip_.rotation(f, j));
      animation.add_rotation(j, std::move(rotations));
    }
    std::vector<float> positions;
    for (std::size_t k = 0; joints > 0 && k < clip_.point_count(); ++k) {
      positions.clear();
      for (std::size_t f = 0; f < frames; ++f) append(positions, scale_ * clip_.position(f, k));
      const std::int32_t joint = k == 0 ? 0 : clip_.translated_joints[k - 1];
      animation.add_translation(static_cast<std::size_t>(joint), positions);
    }
    animation.finish();
  }

  void find_rest_pose() {
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) {
      const std::int32_t parent = skeleton_.parents[j];
      const auto p = static_cast<std::size_t>(parent);
      const Quat turn = parent < 0 ? Quat{} : rotations_[p];
      const Vec3 from = parent < 0 ? Vec3{} : positions_[p];
      rotations_.push_back(normalized(turn * skeleton_.rest_rotations[j]));
      positions_.push_back(from + rotate(turn, scale_ * skeleton_.offsets[j]));
    }
  }

  void add_curves() {
    Json& document = file_.document();
    if (curves_.empty() || !document.contains("animations")) return;
    Json curves = Json::object();
    for (const NamedCurve& curve : curves_) curves[curve.name] = curve.values;
    document["animations"][0]["extras"] = {{"curves", std::move(curves)}};
  }

  void add_skin() {
    find_rest_pose();
    std::vector<float> matrices;
    Json joints = Json::array();
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) {
      const Quat back = conjugate(rotations_[j]);
      for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        append(matrices, rotate(back, axis));
        matrices.push_back(0);
      }
      append(matrices, -rotate(back, positions_[j]));
      matrices.push_back(1);
      joints.push_back(j);
    }
    const GlbMesh mesh = bones();
    if (mesh.positions.empty()) return;
    const std::size_t index = add_mesh(file_, mesh, "bones");
    file_.document()["skins"] =
        Json::array({{{"joints", std::move(joints)},
                      {"skeleton", armature_},
                      {"inverseBindMatrices", file_.add_floats(matrices, 16)}}});
    file_.show(file_.add_node({{"name", "bones"}, {"mesh", index}, {"skin", 0}}));
  }

  GlbMesh bones() const {
    GlbMesh mesh;
    // Bones that are too short would have no normals in single precision.
    const double least = 1e-3 * scale_ * body_height(skeleton_);
    const auto add = [&](std::int32_t joint, Vec3 to) {
      if (joint < 0) return;
      const Vec3 from = positions_[static_cast<std::size_t>(joint)];
      if (norm(to - from) > least) add_bone(mesh, from, to, static_cast<std::uint16_t>(joint));
    };
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) add(skeleton_.parents[j], positions_[j]);
    for (const EndSite& site : skeleton_.end_sites) {
      const auto p = static_cast<std::size_t>(site.parent);
      add(site.parent, positions_[p] + rotate(rotations_[p], scale_ * site.offset));
    }
    return mesh;
  }

  const Take& clip_;
  const Skeleton& skeleton_;
  std::span<const NamedCurve> curves_;
  double scale_;
  GlbBuilder file_;
  std::size_t armature_ = 0;
  std::vector<Quat> rotations_;
  std::vector<Vec3> positions_;
};

std::string new_glb_of_markers(const Take& clip) {
  // Radius of the marker spheres; a millimetre if the unit is unknown. Chosen by hand.
  constexpr double radius_m = 0.008, metres_of_unknown_unit = 0.001;
  const double unit_m = metres_per_unit(clip.unit);
  const double scale = unit_m > 0 ? unit_m : metres_of_unknown_unit;
  GlbBuilder file;
  GlbMesh sphere;
  add_sphere(sphere, radius_m, 2);
  const std::size_t mesh = add_mesh(file, sphere, "marker");
  Json children = Json::array();
  const std::size_t frames = clip.frame_count(), markers = clip.marker_count();
  std::vector<std::vector<std::uint8_t>> present(markers);
  for (std::size_t m = 0; m < markers; ++m) {
    for (std::size_t f = 0; f < frames; ++f) present[m].push_back(clip.is_observed(f, m) ? 1 : 0);
  }
  if (frames > 0) {
    GlbAnimation animation(file, frames, clip.frame_rate_hz);
    for (std::size_t m = 0; m < markers; ++m) {
      const bool ever = std::count(present[m].begin(), present[m].end(), 1) > 0;
      if (!ever || !clip.holds_positions(m)) continue;
      std::vector<float> xyz;
      for (const Vec3& position : held_positions(clip, m)) append(xyz, scale * position);
      const std::size_t node = file.add_node(
          {{"name", clip.names[m]}, {"mesh", mesh}, {"translation", {xyz[0], xyz[1], xyz[2]}}});
      children.push_back(node);
      animation.add_translation(node, xyz);
      const bool always = std::count(present[m].begin(), present[m].end(), 0) == 0;
      if (!always) animation.add_presence(node, present[m]);
    }
    animation.finish();
  }
  Json group{{"name", "markers"}};
  if (!children.empty()) group["children"] = std::move(children);
  file.show(file.add_node(std::move(group)));
  return std::move(file).finish();
}

}  // namespace

std::string new_glb_of(const Take& take, std::span<const NamedCurve> curves) {
  return take.has_joints() ? SkeletonWriter(take, curves).write() : new_glb_of_markers(take);
}

}  // namespace kinemend
