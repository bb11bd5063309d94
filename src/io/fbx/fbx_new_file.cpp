// Writes a take as a new binary FBX file of version 7.5: builds records, and lays out settings,
// definitions, models, curves and connections.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "io/fbx/fbx.hpp"
#include "io/fbx/fbx_rig.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/held_samples.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/take.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

constexpr std::size_t built_header_bytes = 25;
constexpr std::uint32_t built_version = 7500;
// Shorter arrays are not packed, as in the files of Autodesk's programs.
constexpr std::size_t least_packed_bytes = 128;
constexpr double new_file_ticks = 46186158000.0;
constexpr std::string_view animation_name = "Take 001";
// The first three values must match each other. They do not contain the time of writing, so that
// the same take gives the same bytes.
constexpr std::string_view creation_time = "1970-01-01 10:00:00:000";
constexpr std::string_view file_id{
    "\x28\xB3\x2A\xEB\xB6\x24\xCC\xC2\xBF\xC8\xB0\x2A\xA9\x2B\xFC\xF1", 16};
constexpr std::string_view footer_id{
    "\xFA\xBC\xAB\x09\xD0\xC8\xD4\x66\xB1\x76\xFB\x83\x1C\xF7\x26\x7E", 16};
constexpr std::string_view last_bytes{
    "\xF8\x5A\x8C\x6A\xDE\xF5\xD9\x7E\xEC\xE9\x0C\xE3\x75\x8F\x29\x0B", 16};

// A binary FBX file under construction. Records nest: `open` begins one with its properties, which
// come before its children, and `close` ends it.
class FbxBuilder {
 public:
  FbxBuilder() : bytes_("Kaydara FBX Binary  \0\x1A\0", 23) {
    append_word(bytes_, built_version, false);
  }

  FbxBuilder& open(std::string_view name) {
    end_properties();
    if (!open_.empty()) open_.back().has_children = true;
    Level level;
    level.begin = bytes_.size();
    bytes_.append(built_header_bytes - 1, '\0');
    bytes_ += static_cast<char>(name.size());
    bytes_ += name;
    level.properties_begin = bytes_.size();
    open_.push_back(level);
    return *this;
  }

  void close() {
    end_properties();
    const Level level = open_.back();
    // A record without properties ends like a record with children.
    if (level.has_children || level.properties == 0) bytes_.append(built_header_bytes, '\0');
    put_word(bytes_.data() + level.begin, std::uint64_t{bytes_.size()}, false);
    open_.pop_back();
  }

  FbxBuilder& integer(std::int32_t value) { return put('I', static_cast<std::uint32_t>(value)); }
  FbxBuilder& id(std::int64_t value) { return put('L', static_cast<std::uint64_t>(value)); }
  FbxBuilder& number(double value) { return put('D', bits_as<std::uint64_t>(value)); }
  FbxBuilder& string(std::string_view value, char type = 'S') {
    put(type, static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }

  // Adds a record with one value.
  void add(std::string_view name, std::int32_t value) { open(name).integer(value).close(); }
  void add(std::string_view name, std::string_view value) { open(name).string(value).close(); }

  // Adds a record with an array. `type`: the code of its numbers (l, i or f).
  template <class Number, std::size_t N>
  void add_array(std::string_view name, char type, std::span<const Number, N> values) {
    using Word = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    std::string content;
    content.reserve(values.size_bytes());
    for (const Number value : values) append_word(content, bits_as<Word>(value), false);
    open(name).put(type, static_cast<std::uint32_t>(values.size()));
    const bool is_packed = content.size() >= least_packed_bytes;
    if (is_packed) content = fbx_zlib(content);
    append_word(bytes_, std::uint32_t{is_packed ? 1u : 0u}, false);
    append_word(bytes_, static_cast<std::uint32_t>(content.size()), false);
    bytes_ += content;
    close();
  }

  // Begins a line of Properties70: name, type, label and flags, before its values.
  FbxBuilder& property(std::string_view name, std::string_view type, std::string_view label,
                       std::string_view flags) {
    return open("P").string(name).string(type).string(label).string(flags);
  }
  void set_integer(std::string_view name, std::string_view type, std::int32_t value) {
    property(name, type, type == "int" ? "Integer" : "", "").integer(value).close();
  }
  void set_number(std::string_view name, double value) {
    property(name, "double", "Number", "").number(value).close();
  }
  void set_animated(std::string_view name, double value) {
    property(name, "Number", "", "A").number(value).close();
  }
  void set_animated(std::string_view name, Vec3 value) {
    property(name, name, "", "A").number(value.x).number(value.y).number(value.z).close();
  }
  void set_time(std::string_view name, std::int64_t ticks) {
    property(name, "KTime", "Time", "").id(ticks).close();
  }

  // Returns the file's bytes.
  std::string finish() && {
    bytes_.append(built_header_bytes, '\0');
    bytes_ += footer_id;
    // One to sixteen zeros align the following bytes.
    bytes_.append(16 - bytes_.size() % 16, '\0');
    bytes_.append(4, '\0');
    append_word(bytes_, built_version, false);
    bytes_.append(120, '\0');
    bytes_ += last_bytes;
    return std::move(bytes_);
  }

 private:
  struct Level {
    std::size_t begin = 0;
    std::size_t properties_begin = 0;
    std::uint64_t properties = 0;
    bool has_children = false;
  };

  void end_properties() {
    if (open_.empty() || open_.back().has_children) return;
    const Level& level = open_.back();
    put_word(bytes_.data() + level.begin + 8, level.properties, false);
    put_word(bytes_.data() + level.begin + 16,
             std::uint64_t{bytes_.size() - level.properties_begin}, false);
  }

  template <class Word>
  FbxBuilder& put(char type, Word word) {
    bytes_ += type;
    ++open_.back().properties;
    append_word(bytes_, word, false);
    return *this;
  }

  std::string bytes_;
  std::vector<Level> open_;
};

// A model with its animated vectors: F values each, or empty.
struct NewFbxModel {
  std::string name;
  std::int32_t parent = -1;
  bool is_limb = true;
  Vec3 translation, pre_rotation;
  std::int32_t order = 0;
  std::vector<Vec3> translations, rotations;
};

struct NewFbxScene {
  std::vector<NewFbxModel> models;
  std::span<const NamedCurve> curves;  // of the first model
  std::vector<std::int64_t> times;
  double unit_cm = 1;
  double rate_hz = 30;
  bool z_up = false;
};

// Returns a name in UTF-8 without the bytes that end a name.
std::string fbx_name(const std::string& name, const std::string& otherwise) {
  std::string clean;
  for (const char c : name) {
    if (static_cast<unsigned char>(c) >= 0x20) clean += c;
  }
  return clean.empty() ? otherwise : clean;
}

// Returns the FBX order with these axes in this order; empty if an axis is repeated.
std::optional<std::int32_t> order_with(RotationOrder turns) {
  for (std::int32_t order = 0; order < 6; ++order) {
    const RotationOrder factors = fbx_factors(order);
    std::size_t next = 0;
    for (const Axis axis : factors.axes) {
      if (next < turns.count && turns.axes[next] == axis) ++next;
    }
    if (next == turns.count) return order;
  }
  return std::nullopt;
}

std::vector<Vec3> angles_of(const Take& take, std::size_t joint, RotationOrder order) {
  std::vector<Vec3> track;
  std::array<double, 3> near{};
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    near = to_euler_near(take.rotation(f, joint), order, near);
    track.push_back(fbx_degrees(near, order));
  }
  return track;
}

NewFbxModel model_of_joint(const Take& take, std::size_t joint) {
  const Skeleton& skeleton = take.skeleton;
  NewFbxModel model;
  model.name = fbx_name(skeleton.names[joint], "joint");
  model.parent = skeleton.parents[joint];
  model.translation = skeleton.offsets[joint];
  model.pre_rotation =
      fbx_degrees(to_euler(skeleton.rest_rotations[joint], fbx_factors(0)), fbx_factors(0));
  const RotationOrder turns = skeleton.rotation_order(joint);
  model.order = turns.count == 0 ? 0 : order_with(turns).value_or(0);
  bool is_fixed = true;
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    is_fixed = is_fixed && take.rotation(f, joint) == Quat{};
  if (turns.count > 0 || !is_fixed)
    model.rotations = angles_of(take, joint, fbx_factors(model.order));
  if (joint == 0) {
    for (std::size_t f = 0; f < take.frame_count(); ++f)
      model.translations.push_back(take.root_position(f));
  }
  return model;
}

void add_end_sites(const Skeleton& skeleton, NewFbxScene& scene) {
  for (const EndSite& site : skeleton.end_sites) {
    NewFbxModel model;
    const std::string& parent = skeleton.names[static_cast<std::size_t>(site.parent)];
    model.name = fbx_name(site.name, fbx_name(parent, "joint") + "_end");
    model.parent = site.parent;
    model.translation = site.offset;
    scene.models.push_back(std::move(model));
  }
}

void add_joints(const Take& take, NewFbxScene& scene) {
  for (std::size_t j = 0; j < take.joint_count(); ++j)
    scene.models.push_back(model_of_joint(take, j));
  for (std::size_t k = 0; k < take.translated_joints.size(); ++k) {
    NewFbxModel& model = scene.models[static_cast<std::size_t>(take.translated_joints[k])];
    for (std::size_t f = 0; f < take.frame_count(); ++f)
      model.translations.push_back(take.position(f, k + 1));
  }
  add_end_sites(take.skeleton, scene);
  const double metres = likely_metres_per_unit(take);
  scene.unit_cm = metres > 0 ? 100 * metres : 1;
}

void add_markers(const Take& take, NewFbxScene& scene) {
  // A millimetre, as in other formats. Chosen by hand.
  constexpr double cm_of_unknown_unit = 0.1;
  for (std::size_t m = 0; m < take.marker_count(); ++m) {
    if (!take.holds_positions(m)) continue;
    NewFbxModel model;
    model.name = fbx_name(take.names[m], "marker");
    model.is_limb = false;
    model.translations = held_positions(take, m);
    if (!model.translations.empty()) model.translation = model.translations.front();
    scene.models.push_back(std::move(model));
  }
  const double metres = metres_per_unit(take.unit);
  // Files in millimetres state exactly a tenth of a centimetre.
  scene.unit_cm = metres > 0 ? std::round(1e9 * metres) / 1e7 : cm_of_unknown_unit;
}

NewFbxScene scene_of(const Take& take) {
  NewFbxScene scene;
  if (take.has_joints()) {
    add_joints(take, scene);
  } else {
    add_markers(take, scene);
  }
  scene.rate_hz = take.frame_rate_hz;
  scene.z_up = guess_up_axis(take) == Axis::z;
  for (std::size_t f = 0; f < take.frame_count(); ++f)
    scene.times.push_back(std::llround(static_cast<double>(f) * new_file_ticks / scene.rate_hz));
  return scene;
}

// Returns the time mode of a whole standard rate; 14, a custom rate, for all others.
std::int32_t mode_of_rate(double rate_hz) {
  const auto found = std::find(fbx_mode_rates_hz.begin() + 1, fbx_mode_rates_hz.end(), rate_hz);
  const bool is_standard = found != fbx_mode_rates_hz.end() && rate_hz == std::floor(rate_hz);
  return is_standard ? static_cast<std::int32_t>(found - fbx_mode_rates_hz.begin()) : 14;
}

class NewFbxWriter {
 public:
  explicit NewFbxWriter(const NewFbxScene& scene) : scene_(scene) {
    for (const NewFbxModel& model : scene.models) {
      limbs_ += model.is_limb ? 1 : 0;
      tracks_ += (model.translations.empty() ? 0 : 1) + (model.rotations.empty() ? 0 : 1);
    }
  }

  std::string write() {
    write_head();
    write_settings();
    write_documents();
    write_definitions();
    file_.open("Objects");
    write_models();
    write_animation();
    file_.close();
    file_.open("Connections");
    for (const Link& link : links_) write_link(link);
    file_.close();
    write_takes();
    return std::move(file_).finish();
  }

 private:
  struct Link {
    std::int64_t from = 0;
    std::int64_t to = 0;
    std::string property;  // empty: a connection of objects
  };

  std::int64_t stop() const { return scene_.times.empty() ? 0 : scene_.times.back(); }

  static std::string object_name(std::string_view name, std::string_view type) {
    std::string joined(name);
    joined += std::string_view("\0\1", 2);
    return joined += type;
  }

  void write_head() {
    file_.open("FBXHeaderExtension");
    file_.add("FBXHeaderVersion", 1003);
    file_.add("FBXVersion", 7500);
    file_.add("EncryptionType", 0);
    file_.open("CreationTimeStamp");
    constexpr std::array<std::pair<std::string_view, std::int32_t>, 8> stamp{{{"Version", 1000},
                                                                              {"Year", 1970},
                                                                              {"Month", 1},
                                                                              {"Day", 1},
                                                                              {"Hour", 10},
                                                                              {"Minute", 0},
                                                                              {"Second", 0},
                                                                              {"Millisecond", 0}}};
    for (const auto& [name, value] : stamp) file_.add(name, value);
    file_.close();
    file_.add("Creator", "Kinemend");
    file_.close();
    file_.open("FileId").string(file_id, 'R').close();
    file_.add("CreationTime", creation_time);
    file_.add("Creator", "Kinemend");
  }

  void write_settings() {
    file_.open("GlobalSettings");
    file_.add("Version", 1000);
    file_.open("Properties70");
    file_.set_integer("UpAxis", "int", scene_.z_up ? 2 : 1);
    file_.set_integer("UpAxisSign", "int", 1);
    file_.set_integer("FrontAxis", "int", scene_.z_up ? 1 : 2);
    file_.set_integer("FrontAxisSign", "int", scene_.z_up ? -1 : 1);
    file_.set_integer("CoordAxis", "int", 0);
    file_.set_integer("CoordAxisSign", "int", 1);
    file_.set_number("UnitScaleFactor", scene_.unit_cm);
    file_.set_number("OriginalUnitScaleFactor", scene_.unit_cm);
    file_.set_time("TimeSpanStart", 0);
    file_.set_time("TimeSpanStop", stop());
    file_.set_integer("TimeMode", "enum", mode_of_rate(scene_.rate_hz));
    file_.set_number("CustomFrameRate", scene_.rate_hz);
    file_.close();
    file_.close();
  }

  void write_documents() {
    file_.open("Documents");
    file_.add("Count", 1);
    file_.open("Document").id(next_id()).string("Scene").string("Scene");
    file_.open("Properties70");
    file_.property("SourceObject", "object", "", "").close();
    file_.property("ActiveAnimStackName", "KString", "", "").string(animation_name).close();
    file_.close();
    file_.open("RootNode").id(0).close();
    file_.close();
    file_.close();
    file_.open("References").close();
  }

  void define(std::string_view type, std::size_t count) {
    file_.open("ObjectType").string(type);
    file_.add("Count", static_cast<std::int32_t>(count));
    file_.close();
  }

  void write_definitions() {
    const std::size_t models = scene_.models.size(), nodes = tracks_ + scene_.curves.size(),
                      curves = 3 * tracks_ + scene_.curves.size();
    file_.open("Definitions");
    file_.add("Version", 100);
    file_.add("Count", static_cast<std::int32_t>(1 + models + limbs_ + 2 + nodes + curves));
    define("GlobalSettings", 1);
    define("Model", models);
    if (limbs_ > 0) define("NodeAttribute", limbs_);
    define("AnimationStack", 1);
    define("AnimationLayer", 1);
    if (nodes > 0) define("AnimationCurveNode", nodes);
    if (nodes > 0) define("AnimationCurve", curves);
    file_.close();
  }

  void write_models() {
    for (std::size_t m = 0; m < scene_.models.size(); ++m) {
      ids_.push_back(next_id());
      const NewFbxModel& model = scene_.models[m];
      links_.push_back(
          {ids_[m], model.parent < 0 ? 0 : ids_[static_cast<std::size_t>(model.parent)], {}});
      if (model.is_limb) write_attribute(model, ids_[m]);
      write_model(model, ids_[m], m == 0 ? scene_.curves : std::span<const NamedCurve>());
    }
  }

  void write_attribute(const NewFbxModel& model, std::int64_t owner) {
    const std::int64_t id = next_id();
    file_.open("NodeAttribute").id(id).string(object_name(model.name, "NodeAttribute"));
    file_.string("LimbNode");
    file_.add("TypeFlags", "Skeleton");
    file_.close();
    links_.push_back({id, owner, {}});
  }

  void write_model(const NewFbxModel& model, std::int64_t id, std::span<const NamedCurve> curves) {
    file_.open("Model").id(id).string(object_name(model.name, "Model"));
    file_.string(model.is_limb ? "LimbNode" : "Null");
    file_.add("Version", 232);
    file_.open("Properties70");
    file_.set_integer("RotationActive", "bool", 1);
    file_.set_integer("RotationOrder", "enum", model.order);
    const Vec3 pre = model.pre_rotation;
    file_.property("PreRotation", "Vector3D", "Vector", "")
        .number(pre.x)
        .number(pre.y)
        .number(pre.z);
    file_.close();
    file_.set_integer("InheritType", "enum", 1);
    file_.set_animated("Lcl Translation", model.translation);
    file_.set_animated("Lcl Rotation", Vec3{});
    file_.set_animated("Lcl Scaling", Vec3{1, 1, 1});
    for (const NamedCurve& curve : curves)
      file_.property(curve.name, "Number", "", "A+U").number(first_of(curve)).close();
    file_.close();
    file_.add("Culling", "CullingOff");
    file_.close();
  }

  void write_animation() {
    const std::int64_t stack = next_id(), layer = next_id();
    file_.open("AnimationStack").id(stack).string(object_name(animation_name, "AnimStack"));
    file_.string("").open("Properties70");
    for (const std::string_view name : {"LocalStart", "ReferenceStart"}) file_.set_time(name, 0);
    for (const std::string_view name : {"LocalStop", "ReferenceStop"}) file_.set_time(name, stop());
    file_.close();
    file_.close();
    file_.open("AnimationLayer").id(layer).string(object_name("BaseLayer", "AnimLayer"));
    // Readers expect a record within a layer.
    file_.string("").open("Properties70");
    file_.set_animated("Weight", 100);
    file_.close();
    file_.close();
    links_.push_back({layer, stack, {}});
    for (std::size_t m = 0; m < scene_.models.size(); ++m) {
      const NewFbxModel& model = scene_.models[m];
      write_track(model.translations, "T", "Lcl Translation", layer, ids_[m]);
      write_track(model.rotations, "R", "Lcl Rotation", layer, ids_[m]);
    }
    for (const NamedCurve& curve : scene_.curves) write_property(curve, layer, ids_.front());
  }

  static double first_of(const NamedCurve& curve) {
    return curve.values.empty() ? 0 : curve.values.front();
  }

  void write_property(const NamedCurve& curve, std::int64_t layer, std::int64_t model) {
    const std::string channel = "d|" + curve.name;
    const std::int64_t node = next_id();
    file_.open("AnimationCurveNode").id(node).string(object_name(curve.name, "AnimCurveNode"));
    file_.string("").open("Properties70");
    file_.set_animated(channel, first_of(curve));
    file_.close();
    file_.close();
    links_.push_back({node, layer, {}});
    links_.push_back({node, model, curve.name});
    links_.push_back({write_curve({curve.values.begin(), curve.values.end()}), node, channel});
  }

  void write_track(const std::vector<Vec3>& track, std::string_view letter,
                   std::string_view property, std::int64_t layer, std::int64_t model) {
    if (track.empty()) return;
    constexpr std::array<std::string_view, 3> axes{"d|X", "d|Y", "d|Z"};
    const std::int64_t node = next_id();
    file_.open("AnimationCurveNode").id(node).string(object_name(letter, "AnimCurveNode"));
    file_.string("").open("Properties70");
    for (std::size_t a = 0; a < 3; ++a) file_.set_animated(axes[a], component(track.front(), a));
    file_.close();
    file_.close();
    links_.push_back({node, layer, {}});
    links_.push_back({node, model, std::string(property)});
    for (std::size_t a = 0; a < 3; ++a) {
      std::vector<double> values;
      values.reserve(track.size());
      for (const Vec3& value : track) values.push_back(component(value, a));
      links_.push_back({write_curve(values), node, std::string(axes[a])});
    }
  }

  std::int64_t write_curve(const std::vector<double>& curve) {
    // Linear interpolation, with weights of a third (3333 / 9999 twice).
    constexpr std::int32_t linear_flags = 24836;
    constexpr float third_weights = bits_as<float>(std::uint32_t{0x0D050D05});
    const std::vector<float> values(curve.begin(), curve.end());
    const std::int64_t id = next_id();
    file_.open("AnimationCurve").id(id).string(object_name("", "AnimCurve")).string("");
    file_.open("Default").number(curve.empty() ? 0 : curve.front()).close();
    file_.add("KeyVer", 4008);
    file_.add_array("KeyTime", 'l', std::span(scene_.times));
    file_.add_array("KeyValueFloat", 'f', std::span(std::as_const(values)));
    const std::array<std::int32_t, 1> flags{linear_flags};
    const std::array<std::int32_t, 1> uses{static_cast<std::int32_t>(values.size())};
    const std::array<float, 4> data{0, 0, third_weights, 0};
    file_.add_array("KeyAttrFlags", 'i', std::span(flags));
    file_.add_array("KeyAttrDataFloat", 'f', std::span(data));
    file_.add_array("KeyAttrRefCount", 'i', std::span(uses));
    file_.close();
    return id;
  }

  void write_link(const Link& link) {
    file_.open("C").string(link.property.empty() ? "OO" : "OP").id(link.from).id(link.to);
    if (!link.property.empty()) file_.string(link.property);
    file_.close();
  }

  void write_takes() {
    file_.open("Takes");
    file_.add("Current", animation_name);
    file_.open("Take").string(animation_name);
    file_.add("FileName", "Take_001.tak");
    file_.open("LocalTime").id(0).id(stop()).close();
    file_.open("ReferenceTime").id(0).id(stop()).close();
    file_.close();
    file_.close();
  }

  std::int64_t next_id() { return ++last_id_; }

  const NewFbxScene& scene_;
  FbxBuilder file_;
  std::vector<Link> links_;
  std::vector<std::int64_t> ids_;  // ids of models
  std::int64_t last_id_ = 1000000;
  std::size_t limbs_ = 0, tracks_ = 0;
};

}  // namespace

std::string new_fbx_file(const Take& take, std::span<const NamedCurve> curves) {
  take.validate();
  NewFbxScene scene = scene_of(take);
  scene.curves = curves;
  return NewFbxWriter(scene).write();
}

}  // namespace kinemend
