// Collects models, connections, takes and settings, and finds the curves of a take: by connections
// in version 7, by nested channels in version 6.
#include "io/fbx/fbx_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/reading_limits.hpp"
#include "kinemend/extend/frames.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

constexpr std::uint32_t least_version = 6000;
// FBX SDK 2020, FbxTime: ticks of files whose header defines them (TCDefinition, header 1004 on).
constexpr double new_ticks_per_second = 141120000;
constexpr std::int64_t old_ticks_definition = 127, least_header_with_definition = 1004;

double fbx_rate_of_mode(std::int64_t mode, double custom_hz) {
  if (mode == 14 && is_usable_frame_rate(custom_hz)) return custom_hz;
  const bool is_known = mode >= 0 && mode < static_cast<std::int64_t>(fbx_mode_rates_hz.size());
  return fbx_mode_rates_hz[is_known ? static_cast<std::size_t>(mode) : 0];
}

class FbxSceneReader {
 public:
  explicit FbxSceneReader(const FbxTree& tree) : tree_(tree) {}

  FbxScene read() {
    const std::uint32_t objects = tree_.child(no_fbx_record, "Objects");
    if (tree_.version < least_version && tree_.version != 0) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: FBX version {}.{} is too old: 6.0 or later is needed",
                              tree_.name, tree_.version / 1000, tree_.version % 1000 / 100));
    }
    if (objects == no_fbx_record) throw tree_.error_at(0, "the file has no record Objects");
    read_template();
    tree_.for_each_child(objects, [&](std::uint32_t record) { read_object(record); });
    read_connections();
    read_takes();
    read_settings(objects);
    return std::move(scene_);
  }

 private:
  std::string_view name_of(std::uint32_t record) const {
    return tree_.name_of(tree_.records[record]);
  }

  // Reads the default values of models, in Definitions of version 7.
  void read_template() {
    const std::uint32_t definitions = tree_.child(no_fbx_record, "Definitions");
    tree_.for_each_child(definitions, [&](std::uint32_t type) {
      const FbxProperty* const of = tree_.property(tree_.records[type], 0);
      if (of == nullptr || fbx_text(tree_, *of) != "Model") return;
      const std::uint32_t found = tree_.child(type, "PropertyTemplate");
      if (found != no_fbx_record) read_transform(found, template_);
    });
  }

  void read_transform(std::uint32_t object, FbxModel& model) const {
    for_each_fbx_property(tree_, object, [&](const FbxNamedProperty& p) {
      const auto vector = [&](Vec3& v) { v = p.vector(v); };
      if (p.name == "Lcl Translation") return vector(model.local[fbx_translation]);
      if (p.name == "Lcl Rotation") return vector(model.local[fbx_rotation]);
      if (p.name == "Lcl Scaling") return vector(model.local[fbx_scaling]);
      if (p.name == "PreRotation") return vector(model.pre_rotation);
      if (p.name == "PostRotation") return vector(model.post_rotation);
      if (p.name == "RotationOffset") return vector(model.rotation_offset);
      if (p.name == "RotationPivot") return vector(model.rotation_pivot);
      if (p.name == "ScalingOffset") return vector(model.scaling_offset);
      if (p.name == "ScalingPivot") return vector(model.scaling_pivot);
      if (p.name == "RotationOrder") model.rotation_order = p.integer().value_or(0);
      if (p.name == "RotationActive") model.rotation_active = p.integer().value_or(0) != 0;
      if (p.name == "InheritType") model.inherit_type = p.integer().value_or(0);
    });
  }

  // Returns the id of an object: its number, or in version 6 the hash of its name.
  std::int64_t id_of(const FbxProperty& property) const {
    const std::string_view name = fbx_text(tree_, property);
    if (!name.empty() || property.type == 'S') return fbx_id_of_name(name);
    return fbx_integer(tree_, property).value_or(0);
  }

  void read_object(std::uint32_t index) {
    const FbxRecord& record = tree_.records[index];
    const FbxProperty* const first = tree_.property(record, 0);
    if (first == nullptr) return;
    const std::int64_t id = id_of(*first);
    const bool has_number = first->type != 'S';
    scene_.record_of_id.emplace(id, index);
    const FbxProperty* const name = has_number ? tree_.property(record, 1) : first;
    const FbxProperty* const kind = tree_.property(record, has_number ? 2 : 1);
    if (name_of(index) == "Model") read_model(index, id, name, kind);
    if (name_of(index) == "AnimationStack" && name != nullptr)
      scene_.stacks.push_back({fbx_object_name(tree_, *name), id, index});
  }

  void read_model(std::uint32_t index, std::int64_t id, const FbxProperty* name,
                  const FbxProperty* kind) {
    FbxModel model = template_;
    model.record = index;
    if (name != nullptr) model.name = fbx_object_name(tree_, *name);
    if (kind != nullptr) model.kind = fbx_text(tree_, *kind);
    read_transform(index, model);
    const auto place = static_cast<std::int32_t>(scene_.models.size());
    if (scene_.model_of_id.emplace(id, place).second) scene_.models.push_back(std::move(model));
  }

  void read_connections() {
    const std::uint32_t connections = tree_.child(no_fbx_record, "Connections");
    tree_.for_each_child(connections, [&](std::uint32_t index) {
      const FbxRecord& record = tree_.records[index];
      if (record.property_count < 3) return;
      const FbxProperty* const p = &tree_.properties[record.first_property];
      FbxConnection link{id_of(p[1]), id_of(p[2]), {}};
      if (record.property_count > 3) link.property = fbx_text(tree_, p[3]);
      scene_.connections.push_back(link);
      const auto child = scene_.model_of_id.find(link.from);
      const auto parent = scene_.model_of_id.find(link.to);
      if (fbx_text(tree_, p[0]) != "OO" || child == scene_.model_of_id.end() ||
          parent == scene_.model_of_id.end() || child->second == parent->second)
        return;
      std::int32_t& known = scene_.models[static_cast<std::size_t>(child->second)].parent;
      if (known < 0) known = parent->second;
    });
  }

  void read_takes() {
    const std::uint32_t takes = tree_.child(no_fbx_record, "Takes");
    if (takes != no_fbx_record) {
      if (const FbxProperty* const current = fbx_child_value(tree_, takes, "Current"))
        scene_.active_stack = std::string(fbx_text(tree_, *current));
    }
    if (tree_.version >= 7000) {
      read_active_stack();
      return;
    }
    tree_.for_each_child(takes, [&](std::uint32_t index) {
      const FbxProperty* const name = tree_.property(tree_.records[index], 0);
      if (name_of(index) == "Take" && name != nullptr)
        scene_.stacks.push_back({std::string(fbx_text(tree_, *name)), 0, index});
    });
  }

  void read_active_stack() {
    const std::uint32_t documents = tree_.child(no_fbx_record, "Documents");
    tree_.for_each_child(documents, [&](std::uint32_t document) {
      for_each_fbx_property(tree_, document, [&](const FbxNamedProperty& p) {
        if (p.name == "ActiveAnimStackName" && !p.text().empty())
          scene_.active_stack = std::string(p.text());
      });
    });
  }

  void read_settings(std::uint32_t objects) {
    std::uint32_t settings = tree_.child(no_fbx_record, "GlobalSettings");
    if (settings == no_fbx_record) settings = tree_.child(objects, "GlobalSettings");
    std::int64_t mode = tree_.version < 7000 ? mode_of_version_6() : 0;
    double custom_hz = 0;
    if (settings != no_fbx_record) {
      for_each_fbx_property(tree_, settings, [&](const FbxNamedProperty& p) {
        if (p.name == "UpAxis") scene_.up_axis = p.integer().value_or(1);
        if (p.name == "UnitScaleFactor") scene_.unit_cm = p.number().value_or(1);
        if (p.name == "TimeMode") mode = p.integer().value_or(0);
        if (p.name == "CustomFrameRate") custom_hz = p.number().value_or(0);
      });
    }
    if (!(scene_.unit_cm > 1e-6 && scene_.unit_cm < 1e6)) scene_.unit_cm = 1;
    scene_.frame_rate_hz = fbx_rate_of_mode(mode, custom_hz);
    read_ticks();
  }

  // Returns the mode of `FrameRate: "24"` in Version5.
  std::int64_t mode_of_version_6() const {
    const std::uint32_t version5 = tree_.child(no_fbx_record, "Version5");
    if (version5 == no_fbx_record) return 0;
    const std::uint32_t settings = tree_.child(version5, "Settings");
    if (settings == no_fbx_record) return 0;
    const FbxProperty* const rate = fbx_child_value(tree_, settings, "FrameRate");
    const std::string_view text = rate == nullptr ? std::string_view{} : fbx_text(tree_, *rate);
    for (std::int64_t mode = 1; mode <= 18; ++mode) {
      if (text == fmt::format("{}", fbx_rate_of_mode(mode, 0))) return mode;
    }
    return 0;
  }

  void read_ticks() {
    const std::uint32_t header = tree_.child(no_fbx_record, "FBXHeaderExtension");
    const bool is_new = tree_.version >= 8000;
    std::int64_t definition = is_new ? 0 : old_ticks_definition;
    if (header != no_fbx_record &&
        (is_new ||
         fbx_child_integer(tree_, header, "FBXHeaderVersion", 0) >= least_header_with_definition)) {
      const std::uint32_t flags = tree_.child(header, "OtherFlags");
      if (flags != no_fbx_record)
        definition = fbx_child_integer(tree_, flags, "TCDefinition", definition);
    }
    if (definition != old_ticks_definition) scene_.ticks_per_second = new_ticks_per_second;
  }

  const FbxTree& tree_;
  FbxScene scene_;
  FbxModel template_;
};

}  // namespace

Vec3 FbxNamedProperty::vector(Vec3 otherwise) const {
  Vec3 v;
  double* const parts[3] = {&v.x, &v.y, &v.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> part = number(i);
    if (!part || !(std::fabs(*part) <= largest_fbx_value)) return otherwise;
    *parts[i] = *part;
  }
  return v;
}

std::int64_t fbx_id_of_name(std::string_view name) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return static_cast<std::int64_t>(hash);
}

FbxScene read_fbx_scene(const FbxTree& tree) { return FbxSceneReader(tree).read(); }

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
    tree_.for_each_child(parent, [&](std::uint32_t child) {
      const FbxRecord& record = tree_.records[child];
      const FbxProperty* const name = tree_.property(record, 0);
      if (name != nullptr && tree_.name_of(record) == type) visit(child, fbx_text(tree_, *name));
    });
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
      FbxCurve curve = keys_.begin(index);
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
