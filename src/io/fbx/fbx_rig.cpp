// Walks over the tree of models to find the joints, evaluates curves and layers, and chains the
// transforms of the models.
#include "io/fbx/fbx_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

bool is_limb(const FbxModel& model) {
  return model.kind == "LimbNode" || model.kind == "Limb" || model.kind == "Root";
}

// Cameras and lights are never joints.
bool is_onlooker(const FbxModel& model) {
  return model.kind == "Camera" || model.kind == "CameraSwitcher" || model.kind == "Light";
}

class FbxRigBuilder {
 public:
  FbxRigBuilder(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                std::size_t max_depth)
      : tree_(tree), scene_(scene), motion_(motion), max_depth_(max_depth) {}

  FbxRig build() {
    order_models();
    find_animated();
    mark_relatives();
    for (const std::size_t m : order_) joint_[m] = is_joint(m);
    add_nodes();
    return std::move(rig_);
  }

 private:
  std::size_t count() const { return scene_.models.size(); }
  std::int32_t parent_of(std::size_t model) const { return scene_.models[model].parent; }

  // Orders models depth first, in the order of the file. Models that are their own ancestors are
  // left out.
  void order_models() {
    std::vector<std::vector<std::size_t>> children(count());
    std::vector<std::pair<std::size_t, std::size_t>> open;  // model, depth
    for (std::size_t m = count(); m-- > 0;) {
      if (parent_of(m) < 0) {
        open.emplace_back(m, 1);
      } else {
        children[static_cast<std::size_t>(parent_of(m))].push_back(m);
      }
    }
    while (!open.empty()) {
      const auto [model, depth] = open.back();
      open.pop_back();
      if (depth > max_depth_) {
        throw tree_.error_at(tree_.records[scene_.models[model].record].begin,
                             fmt::format("models are nested deeper than {}", max_depth_));
      }
      order_.push_back(model);
      for (const std::size_t child : children[model]) open.emplace_back(child, depth + 1);
    }
  }

  void find_animated() {
    animated_.assign(count(), false);
    moving_.assign(count(), false);
    for (const FbxLayer& layer : motion_.layers) {
      for (const auto& [key, vector] : layer.vectors) {
        for (const std::int32_t curve : vector.curves) {
          if (curve < 0) continue;
          animated_[key / 3] = true;
          if (!motion_.curves[static_cast<std::size_t>(curve)].is_constant())
            moving_[key / 3] = true;
        }
      }
    }
  }

  void mark_relatives() {
    joint_.assign(count(), false);
    above_.assign(count(), false);
    below_.assign(count(), false);
    for (std::size_t i = order_.size(); i-- > 0;) {
      const std::size_t m = order_[i];
      has_limbs_ = has_limbs_ || is_limb(scene_.models[m]);
      if (parent_of(m) >= 0 && (is_limb(scene_.models[m]) || above_[m]))
        above_[static_cast<std::size_t>(parent_of(m))] = true;
    }
    for (const std::size_t m : order_) {
      if (parent_of(m) < 0) continue;
      const auto p = static_cast<std::size_t>(parent_of(m));
      const bool counts = is_limb(scene_.models[p]) || (!has_limbs_ && animated_[p]);
      below_[m] = below_[p] || counts;
    }
  }

  bool is_joint(std::size_t m) const {
    const FbxModel& model = scene_.models[m];
    const bool is_null = model.kind == "Null";
    if (!has_limbs_) return (animated_[m] && !is_onlooker(model)) || (is_null && below_[m]);
    return is_limb(model) || (moving_[m] && above_[m]) || (animated_[m] && is_null && below_[m]);
  }

  void add_nodes() {
    std::vector<bool> needed(count(), false);
    for (std::size_t i = order_.size(); i-- > 0;) {
      const std::size_t m = order_[i];
      needed[m] = needed[m] || joint_[m];
      if (needed[m] && parent_of(m) >= 0) needed[static_cast<std::size_t>(parent_of(m))] = true;
    }
    std::vector<std::int32_t> node_of(count(), -1);
    for (const std::size_t m : order_) {
      if (!needed[m]) continue;
      node_of[m] = static_cast<std::int32_t>(rig_.nodes.size());
      const std::int32_t parent =
          parent_of(m) < 0 ? -1 : node_of[static_cast<std::size_t>(parent_of(m))];
      rig_.nodes.push_back(node_for(m, parent));
    }
  }

  FbxRigNode node_for(std::size_t m, std::int32_t parent) {
    const FbxModel& model = scene_.models[m];
    FbxRigNode node;
    node.model = m;
    node.parent = parent;
    if (parent >= 0) {
      const FbxRigNode& above = rig_.nodes[static_cast<std::size_t>(parent)];
      node.parent_joint = above.joint >= 0 ? above.joint : above.parent_joint;
    }
    node.order = fbx_factors(model.rotation_active ? model.rotation_order : 0);
    if (model.rotation_active) {
      node.pre = fbx_turn(model.pre_rotation, fbx_factors(0));
      node.post = fbx_turn(model.post_rotation, fbx_factors(0));
    }
    find_turns(node);
    if (joint_[m]) {
      node.joint = static_cast<std::int32_t>(rig_.joints.size());
      rig_.joints.push_back(rig_.nodes.size());
    }
    return node;
  }

  // Finds which of the model's rotations have curves, and the constant rotations behind them.
  void find_turns(FbxRigNode& node) const {
    std::array<bool, 3> has_curve{};
    Vec3 constant = scene_.models[node.model].local[fbx_rotation];
    std::size_t layers = 0;
    for (const FbxLayer& layer : motion_.layers) {
      const FbxAnimatedVector* const moved = layer.find(node.model, fbx_translation);
      if (moved != nullptr && has_curves(*moved)) node.has_translation_curves = true;
      const FbxAnimatedVector* const turned = layer.find(node.model, fbx_rotation);
      if (turned == nullptr) continue;
      ++layers;
      constant = turned->constant;
      for (std::size_t a = 0; a < 3; ++a) has_curve[a] = has_curve[a] || turned->curves[a] >= 0;
    }
    node.first_turn = 0;
    node.end_turn = 3;
    const auto turns = [&](std::size_t i) {
      return has_curve[static_cast<std::size_t>(node.order.axes[i])];
    };
    const bool any = has_curve[0] || has_curve[1] || has_curve[2];
    // The result of several layers is not a rotation about single axes.
    const bool is_first = !motion_.layers.empty() && !motion_.layers.front().is_muted &&
                          motion_.layers.front().find(node.model, fbx_rotation) != nullptr;
    if (any && !(layers == 1 && is_first)) {
      node.tail = conjugate(node.post);
      return;
    }
    while (node.end_turn > 0 && !turns(node.end_turn - 1)) --node.end_turn;
    while (node.first_turn < node.end_turn && !turns(node.first_turn)) ++node.first_turn;
    if (!any) node.first_turn = node.end_turn = 3;
    Vec3 behind;
    for (std::size_t i = node.end_turn; i < 3; ++i) {
      const Axis axis = node.order.axes[i];
      component_of(behind, axis) = component(constant, axis);
    }
    node.tail = fbx_turn(behind, node.order) * conjugate(node.post);
  }

  static bool has_curves(const FbxAnimatedVector& vector) {
    return std::any_of(vector.curves.begin(), vector.curves.end(),
                       [](std::int32_t curve) { return curve >= 0; });
  }

  const FbxTree& tree_;
  const FbxScene& scene_;
  const FbxMotion& motion_;
  std::size_t max_depth_;
  FbxRig rig_;
  std::vector<std::size_t> order_;
  std::vector<bool> animated_;  // 1 if the model has curves
  std::vector<bool> moving_;    // 1 if it has curves that are not constant
  std::vector<bool> joint_, above_, below_;
  bool has_limbs_ = false;
};

}  // namespace

FbxRig choose_fbx_rig(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                      std::size_t max_depth) {
  return FbxRigBuilder(tree, scene, motion, max_depth).build();
}

RotationOrder fbx_factors(std::int64_t rotation_order) {
  constexpr Axis x = Axis::x, y = Axis::y, z = Axis::z;
  // An order is named by the order in which the rotations act, so the product is reversed.
  constexpr std::array<std::array<Axis, 3>, 6> factors{
      {{z, y, x}, {y, z, x}, {x, z, y}, {z, x, y}, {y, x, z}, {x, y, z}}};
  const bool is_known = rotation_order >= 0 && rotation_order < 6;
  return {factors[is_known ? static_cast<std::size_t>(rotation_order) : 0], 3};
}

Quat fbx_turn(Vec3 degrees, RotationOrder factors) {
  std::array<double, 3> angles{};
  for (std::size_t i = 0; i < 3; ++i)
    angles[i] = radians_per_degree * component(degrees, factors.axes[i]);
  return from_euler(angles, factors);
}

Vec3 fbx_degrees(const std::array<double, 3>& angles, RotationOrder factors) {
  Vec3 degrees;
  for (std::size_t i = 0; i < factors.count; ++i)
    component_of(degrees, factors.axes[i]) = degrees_per_radian * angles[i];
  return degrees;
}

namespace {

Quat fbx_share(Quat rotation, double weight) {
  const Quat near = rotation.w < 0 ? -rotation : rotation;
  return weight == 1 ? near : exp(weight * log(near));
}

Vec3 mix_rotations(Vec3 below, Vec3 value, const FbxLayer& layer, RotationOrder order) {
  const Quat under = fbx_turn(below, order), over = fbx_turn(value, order);
  const Quat mixed = layer.is_override
                         ? under * fbx_share(normalized(conjugate(under) * over), layer.weight)
                         : under * fbx_share(over, layer.weight);
  return fbx_degrees(to_euler(normalized(mixed), order), order);
}

Vec3 mix_scales(Vec3 below, Vec3 value, double weight) {
  return {below.x * portable::pow(std::fabs(value.x), weight),
          below.y * portable::pow(std::fabs(value.y), weight),
          below.z * portable::pow(std::fabs(value.z), weight)};
}

// Returns the value of the layers below mixed with a layer.
Vec3 mix_layer(Vec3 below, Vec3 value, const FbxLayer& layer, FbxVector vector,
               RotationOrder order) {
  if (vector == fbx_rotation && !layer.adds_rotations_by_channel)
    return mix_rotations(below, value, layer, order);
  if (layer.is_override) return below + layer.weight * (value - below);
  if (vector == fbx_scaling) return mix_scales(below, value, layer.weight);
  return below + layer.weight * value;
}

FbxMatrix scaled(const FbxMatrix& m, Vec3 s) {
  FbxMatrix out;
  for (std::size_t i = 0; i < 3; ++i)
    out.rows[i] = {m.rows[i].x * s.x, m.rows[i].y * s.y, m.rows[i].z * s.z};
  return out;
}

}  // namespace

FbxMatrix operator*(const FbxMatrix& a, const FbxMatrix& b) {
  FbxMatrix out;
  for (std::size_t i = 0; i < 3; ++i)
    out.rows[i] = a.rows[i].x * b.rows[0] + a.rows[i].y * b.rows[1] + a.rows[i].z * b.rows[2];
  return out;
}

Vec3 operator*(const FbxMatrix& a, Vec3 v) {
  return {dot(a.rows[0], v), dot(a.rows[1], v), dot(a.rows[2], v)};
}

FbxMatrix fbx_matrix(Quat rotation) {
  const Vec3 x = rotate(rotation, {1, 0, 0}), y = rotate(rotation, {0, 1, 0}),
             z = rotate(rotation, {0, 0, 1});
  return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}};
}

bool invert_fbx_matrix(const FbxMatrix& matrix, FbxMatrix& inverse) {
  const auto& [a, b, c] = matrix.rows;
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = dot(a, bc);
  const double size = norm(a) * norm(b) * norm(c);
  if (!(std::fabs(determinant) > 1e-9 * size) || !std::isfinite(1 / determinant)) return false;
  const double f = 1 / determinant;
  inverse.rows = {Vec3{f * bc.x, f * ca.x, f * ab.x}, Vec3{f * bc.y, f * ca.y, f * ab.y},
                  Vec3{f * bc.z, f * ca.z, f * ab.z}};
  return true;
}

FbxMatrix fbx_step_matrix(const FbxRig& rig, const std::vector<FbxNodePose>& poses,
                          const FbxRigNode& node) {
  FbxMatrix matrix;
  if (node.parent >= 0) matrix = poses[static_cast<std::size_t>(node.parent)].linear;
  if (node.parent_joint < 0) return matrix;
  const std::size_t above = rig.joints[static_cast<std::size_t>(node.parent_joint)];
  return fbx_matrix(conjugate(poses[above].joint_turn)) * matrix;
}

FbxPoser::FbxPoser(const FbxScene& scene, const FbxMotion& motion, const FbxRig& rig)
    : scene_(scene),
      motion_(motion),
      rig_(rig),
      animated_(rig.nodes.size()),
      cursors_(motion.curves.size()),
      is_animated_(3 * rig.nodes.size()),
      poses_(rig.nodes.size()) {
  for (std::size_t n = 0; n < rig.nodes.size(); ++n) {
    poses_[n].local = scene.models[rig.nodes[n].model].local;
    for (std::size_t v = 0; v < 3; ++v) {
      for (const FbxLayer& layer : motion.layers) {
        const FbxAnimatedVector* const found =
            layer.is_muted ? nullptr : layer.find(rig.nodes[n].model, v);
        animated_[n][v].push_back(found);
        is_animated_[3 * n + v] = is_animated_[3 * n + v] || found != nullptr;
      }
    }
  }
}

const std::vector<FbxNodePose>& FbxPoser::at(std::int64_t time) {
  for (std::size_t n = 0; n < poses_.size(); ++n) {
    for (const FbxVector vector : {fbx_translation, fbx_rotation, fbx_scaling})
      evaluate(n, vector, time);
    place(n);
  }
  return poses_;
}

void FbxPoser::locals_over(std::size_t n, FbxVector vector, std::span<const std::int64_t> times,
                           std::span<Vec3> out) {
  if (!is_animated_[3 * n + vector]) {
    std::fill(out.begin(), out.end(), scene_.models[rig_.nodes[n].model].local[vector]);
  } else if (motion_.layers.size() > 1) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      evaluate(n, vector, times[i]);
      out[i] = poses_[n].local[vector];
    }
  } else {
    const FbxAnimatedVector& animated = *animated_[n][vector].front();
    std::fill(out.begin(), out.end(), animated.constant);
    for (std::size_t a = 0; a < 3; ++a) {
      if (animated.curves[a] < 0) continue;
      const FbxCurve& curve = motion_.curves[static_cast<std::size_t>(animated.curves[a])];
      std::size_t cursor = 0;
      for (std::size_t i = 0; i < times.size(); ++i)
        component_of(out[i], a) = fbx_value_at(curve, times[i], scene_.ticks_per_second, cursor);
    }
  }
}

Vec3 FbxPoser::layer_value(const FbxAnimatedVector& animated, std::int64_t time) {
  Vec3 value = animated.constant;
  for (std::size_t a = 0; a < 3; ++a) {
    if (animated.curves[a] < 0) continue;
    const auto curve = static_cast<std::size_t>(animated.curves[a]);
    component_of(value, a) =
        fbx_value_at(motion_.curves[curve], time, scene_.ticks_per_second, cursors_[curve]);
  }
  return value;
}

void FbxPoser::evaluate(std::size_t n, FbxVector vector, std::int64_t time) {
  if (!is_animated_[3 * n + vector]) return;
  // The first layer replaces the value at rest; the other layers are mixed with the layers below.
  Vec3 value = scene_.models[rig_.nodes[n].model].local[vector];
  for (std::size_t l = 0; l < motion_.layers.size(); ++l) {
    const FbxAnimatedVector* const animated = animated_[n][vector][l];
    if (animated == nullptr) continue;
    const Vec3 layer = layer_value(*animated, time);
    value =
        l == 0 ? layer : mix_layer(value, layer, motion_.layers[l], vector, rig_.nodes[n].order);
  }
  poses_[n].local[vector] = value;
}

void FbxPoser::place(std::size_t n) {
  const FbxRigNode& node = rig_.nodes[n];
  const FbxModel& model = scene_.models[node.model];
  FbxNodePose& pose = poses_[n];
  const Quat turn =
      node.pre * fbx_turn(pose.local[fbx_rotation], node.order) * conjugate(node.post);
  const Vec3 centre = pose.local[fbx_translation] + model.rotation_offset + model.rotation_pivot;
  if (node.parent < 0) {
    pose.turn = normalized(turn);
    pose.unscaled = fbx_matrix(pose.turn);
    pose.centre = centre;
  } else {
    const auto p = static_cast<std::size_t>(node.parent);
    const FbxNodePose& above = poses_[p];
    const FbxModel& upper = scene_.models[rig_.nodes[p].model];
    pose.turn = normalized(above.turn * turn);
    const Vec3 pivots = upper.scaling_offset + upper.scaling_pivot - upper.rotation_pivot;
    pose.centre =
        above.centre + above.unscaled * pivots + above.linear * (centre - upper.scaling_pivot);
    if (model.inherit_type == 1) {
      pose.unscaled = above.linear * fbx_matrix(turn);
    } else {
      const FbxMatrix& upper_scales = model.inherit_type == 2 ? above.unscaled : above.linear;
      pose.unscaled = fbx_matrix(pose.turn) * (fbx_matrix(conjugate(above.turn)) * upper_scales);
    }
  }
  pose.linear = scaled(pose.unscaled, pose.local[fbx_scaling]);
  pose.joint_turn = normalized(pose.turn * conjugate(node.tail));
}

}  // namespace kinemend
