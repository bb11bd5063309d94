// Makes new files: skeletons as skinned bones, and markers as small spheres.
#include <algorithm>
#include <cmath>

#include "io/gltf/glb_builder.hpp"
#include "io/gltf/gltf_new.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

namespace {

Json json_of(Vec3 v) { return to_floats(v); }

Json json_of(Quat q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
          static_cast<float>(q.w)};
}

double metres_of(const Take& clip) {
  const double metres = likely_metres_per_unit(clip);
  return metres > 0 ? metres : 1;
}

void append(std::vector<float>& values, Vec3 v) {
  const auto floats = to_floats(v);
  values.insert(values.end(), floats.begin(), floats.end());
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
  explicit SkeletonWriter(const Take& clip)
      : clip_(clip), skeleton_(clip.skeleton), scale_(metres_of(clip)) {}

  std::string write() {
    add_nodes();
    add_animation();
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
    file_.document()["scenes"][0]["nodes"].push_back(armature_);
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
    if (mesh.vertices() == 0) return;
    const std::size_t index = add_mesh(file_, mesh, "bones");
    file_.document()["skins"] =
        Json::array({{{"joints", std::move(joints)},
                      {"skeleton", armature_},
                      {"inverseBindMatrices", file_.add_floats(matrices, 16, false, false)}}});
    file_.document()["scenes"][0]["nodes"].push_back(
        file_.add_node({{"name", "bones"}, {"mesh", index}, {"skin", 0}}));
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
  double scale_;
  GlbBuilder file_;
  std::size_t armature_ = 0;
  std::vector<Quat> rotations_;
  std::vector<Vec3> positions_;
};

// Returns positions in which missing samples have the last known position of the marker, or the
// first.
std::vector<Vec3> held_track(const Take& clip, std::size_t marker) {
  std::vector<Vec3> track(clip.frame_count());
  std::size_t known = 0;
  while (!clip.is_observed(known, marker)) ++known;
  Vec3 last = clip.position(known, marker);
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (clip.is_observed(f, marker)) last = clip.position(f, marker);
    track[f] = last;
  }
  return track;
}

}  // namespace

std::string new_glb_of_joints(const Take& clip) { return SkeletonWriter(clip).write(); }

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
      const bool is_place = clip.is_position.empty() || clip.is_position[m] != 0;
      if (!ever || !is_place) continue;
      std::vector<float> xyz;
      for (const Vec3& position : held_track(clip, m)) append(xyz, scale * position);
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
  const std::size_t root = file.add_node(std::move(group));
  file.document()["scenes"][0]["nodes"].push_back(root);
  return std::move(file).finish();
}

}  // namespace kinemend
