// Finds the curves of a take: by connections in version 7, by nested channels in version 6.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/fbx/fbx_keys.hpp"
#include "io/fbx/fbx_properties.hpp"
#include "io/fbx/fbx_scene.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/first_error.hpp"
#include "motion/component.hpp"

namespace kinemend {

namespace {

constexpr std::array<std::string_view, 3> vector_names{"Lcl Translation", "Lcl Rotation",
                                                       "Lcl Scaling"};
constexpr std::array<std::string_view, 3> axis_names{"d|X", "d|Y", "d|Z"};
constexpr std::array<std::string_view, 3> channel_names_6{"T", "R", "S"};
constexpr std::array<std::string_view, 3> axis_names_6{"X", "Y", "Z"};

template <std::size_t N>
int index_in(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// Returns the value of an added layer that adds nothing.
Vec3 neutral(int vector) { return vector == fbx_scaling ? Vec3{1, 1, 1} : Vec3{}; }

bool is_neutral(const FbxAnimatedVector& animated, int vector) {
  return animated.curves == std::array<std::int32_t, 3>{-1, -1, -1} &&
         animated.constant == neutral(vector);
}

class FbxMotionReader {
 public:
  FbxMotionReader(const FbxTree& tree, const FbxScene& scene)
      : tree_(tree), scene_(scene), keys_(tree) {
    for (const FbxConnection& link : scene.connections) into_[link.to].push_back(&link);
  }

  FbxMotion read(const FbxStack& stack) {
    for (const FbxConnection* link : links_to(stack.id)) {
      if (is(link->from, "AnimationLayer")) read_layer(link->from);
    }
    find_targets();
    for_each_first_error(motion_.curves.size(),
                         [&](std::size_t c) { keys_.finish(motion_.curves[c]); });
    return std::move(motion_);
  }

 private:
  const std::vector<const FbxConnection*>& links_to(std::int64_t id) const {
    static const std::vector<const FbxConnection*> none;
    const auto found = into_.find(id);
    return found == into_.end() ? none : found->second;
  }

  bool is(std::int64_t id, std::string_view type) const {
    const auto record = scene_.record_of_id.find(id);
    return record != scene_.record_of_id.end() &&
           tree_.name_of(tree_.records[record->second]) == type;
  }

  void read_layer(std::int64_t id) {
    FbxLayer layer;
    for_each_fbx_property(tree_, scene_.record_of_id.at(id), [&](const FbxNamedProperty& p) {
      if (p.name == "Weight") layer.weight = std::clamp(p.number().value_or(100) / 100, 0.0, 1.0);
      if (p.name == "Mute") layer.is_muted = p.integer().value_or(0) != 0;
      if (p.name == "BlendMode") layer.is_override = p.integer().value_or(0) != 0;
      if (p.name == "RotationAccumulationMode")
        layer.adds_rotations_by_channel = p.integer().value_or(0) == 1;
    });
    const std::size_t index = motion_.layers.size();
    motion_.layers.push_back(std::move(layer));
    for (const FbxConnection* link : links_to(id)) {
      if (is(link->from, "AnimationCurveNode")) layer_of_node_.emplace(link->from, index);
    }
  }

  // Finds targets in the order of the connections, so that the same file gives the same take.
  void find_targets() {
    for (const FbxConnection& link : scene_.connections) {
      const int vector = index_in(vector_names, link.property);
      const auto node = layer_of_node_.find(link.from);
      const auto model = scene_.model_of_id.find(link.to);
      if (vector < 0 || node == layer_of_node_.end() || model == scene_.model_of_id.end()) continue;
      const auto owner = static_cast<std::size_t>(model->second);
      const Vec3 rest = scene_.models[owner].local[static_cast<std::size_t>(vector)];
      const bool is_added = node->second > 0 && !motion_.layers[node->second].is_override;
      const FbxAnimatedVector animated = vector_of(link.from, is_added ? neutral(vector) : rest);
      if (is_added && is_neutral(animated, vector)) continue;
      motion_.layers[node->second].vectors.insert_or_assign(
          3 * owner + static_cast<std::size_t>(vector), animated);
    }
  }

  // Returns a node's values of a vector; NaN for an axis that it leaves to the model.
  const FbxAnimatedVector& vector_of(std::int64_t node) {
    const auto known = vector_of_node_.find(node);
    if (known != vector_of_node_.end()) return known->second;
    FbxAnimatedVector animated;
    animated.constant = {std::nan(""), std::nan(""), std::nan("")};
    for_each_fbx_property(tree_, scene_.record_of_id.at(node), [&](const FbxNamedProperty& p) {
      const int axis = index_in(axis_names, p.name);
      const std::optional<double> value = axis < 0 ? std::nullopt : p.number();
      if (value && std::fabs(*value) <= largest_fbx_value)
        component_of(animated.constant, static_cast<std::size_t>(axis)) = *value;
    });
    for (const FbxConnection* link : links_to(node)) {
      const int axis = index_in(axis_names, link->property);
      if (axis < 0 || !is(link->from, "AnimationCurve")) continue;
      animated.curves[static_cast<std::size_t>(axis)] = curve_of(link->from);
    }
    return vector_of_node_.emplace(node, animated).first->second;
  }

  FbxAnimatedVector vector_of(std::int64_t node, Vec3 rest) {
    FbxAnimatedVector animated = vector_of(node);
    for (std::size_t a = 0; a < 3; ++a) {
      double& value = component_of(animated.constant, a);
      if (std::isnan(value)) value = component(rest, a);
    }
    return animated;
  }

  // Returns the index of a curve, or -1 for a curve without keys. A curve may animate several
  // vectors.
  std::int32_t curve_of(std::int64_t id) {
    const auto known = curve_of_id_.find(id);
    if (known != curve_of_id_.end()) return known->second;
    FbxCurve curve = keys_.begin(scene_.record_of_id.at(id));
    std::int32_t index = -1;
    if (curve.times != nullptr && curve.times->empty()) keys_.finish(curve);
    if (curve.times != nullptr && !curve.times->empty()) {
      index = static_cast<std::int32_t>(motion_.curves.size());
      motion_.curves.push_back(std::move(curve));
    }
    curve_of_id_.emplace(id, index);
    return index;
  }

  const FbxTree& tree_;
  const FbxScene& scene_;
  FbxKeyReader keys_;
  FbxMotion motion_;
  std::unordered_map<std::int64_t, std::vector<const FbxConnection*>> into_;
  std::unordered_map<std::int64_t, std::size_t> layer_of_node_;
  std::unordered_map<std::int64_t, std::int32_t> curve_of_id_;
  std::unordered_map<std::int64_t, FbxAnimatedVector> vector_of_node_;
};

class FbxMotionReader6 {
 public:
  FbxMotionReader6(const FbxTree& tree, const FbxScene& scene)
      : tree_(tree), scene_(scene), keys_(tree) {}

  FbxMotion read(const FbxStack& stack) {
    motion_.layers.emplace_back();
    for_each_named(stack.record, "Model", [&](std::uint32_t index, std::string_view name) {
      const auto model = scene_.model_of_id.find(fbx_id_of_name(name));
      if (model != scene_.model_of_id.end())
        read_model(index, static_cast<std::size_t>(model->second));
    });
    return std::move(motion_);
  }

 private:
  template <class Visit>
  void for_each_named(std::uint32_t parent, std::string_view type, Visit&& visit) const {
    for (std::uint32_t child = tree_.records[parent].first_child; child != no_fbx_record;
         child = tree_.records[child].next_sibling) {
      const FbxRecord& record = tree_.records[child];
      const FbxProperty* const name = tree_.property(record, 0);
      if (name != nullptr && tree_.name_of(record) == type) visit(child, fbx_text(tree_, *name));
    }
  }

  void read_model(std::uint32_t index, std::size_t model) {
    for_each_named(index, "Channel", [&](std::uint32_t transform, std::string_view name) {
      if (name != "Transform") return;
      for_each_named(transform, "Channel", [&](std::uint32_t channel, std::string_view letter) {
        const int vector = index_in(channel_names_6, letter);
        if (vector >= 0) read_vector(channel, model, static_cast<std::size_t>(vector));
      });
    });
  }

  void read_vector(std::uint32_t channel, std::size_t model, std::size_t vector) {
    FbxAnimatedVector animated;
    animated.constant = scene_.models[model].local[vector];
    for_each_named(channel, "Channel", [&](std::uint32_t index, std::string_view letter) {
      const int axis = index_in(axis_names_6, letter);
      if (axis < 0) return;
      const auto a = static_cast<std::size_t>(axis);
      if (const FbxProperty* const value = fbx_child_value(tree_, index, "Default")) {
        const std::optional<double> number = fbx_number(tree_, *value);
        if (number && std::fabs(*number) <= largest_fbx_value)
          component_of(animated.constant, a) = *number;
      }
      if (tree_.child(index, "Key") == no_fbx_record) return;
      FbxCurve curve = keys_.read(index);
      if (curve.values.empty()) return;
      animated.curves[a] = static_cast<std::int32_t>(motion_.curves.size());
      motion_.curves.push_back(std::move(curve));
    });
    motion_.layers.front().vectors.insert_or_assign(3 * model + vector, animated);
  }

  const FbxTree& tree_;
  const FbxScene& scene_;
  FbxKeyReader keys_;
  FbxMotion motion_;
};

}  // namespace

FbxMotion read_fbx_motion(const FbxTree& tree, const FbxScene& scene, const FbxStack& stack) {
  if (tree.version >= 7000) return FbxMotionReader(tree, scene).read(stack);
  return FbxMotionReader6(tree, scene).read(stack);
}

}  // namespace kinemend
