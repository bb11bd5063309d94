// Reads FBX files as takes of joints, or as takes of markers if they hold only points. Writes FBX
// into the source file of the take, where it finds the changed curves and the new values of their
// keys, or as a new file.
#include "io/fbx/fbx.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "io/fbx/fbx_document.hpp"
#include "io/fbx/fbx_patch.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/held_samples.hpp"
#include "io/motion/motion_write.hpp"
#include "io/reading_limits.hpp"
#include "io/text/text.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"
#include "motion/rotation.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// How many takes are tried to find one with motion. Chosen by hand.
constexpr std::size_t tried_stacks = 64;

class FbxReader {
 public:
  FbxReader(FbxDocument& document, const ReadOptions& options)
      : document_(document), options_(options) {}

  Take read(Diagnostics& diagnostics) {
    diagnostics_ = &diagnostics;
    document_.scene = read_fbx_scene(tree());
    choose_stack();
    mend_curves();
    document_.rig = choose_fbx_rig(tree(), document_.scene, document_.motion, options_.max_depth);
    if (document_.rig.joints.empty()) throw no_joints();
    find_frames();
    Take take = take_of_fbx(document_);
    check_fbx_take(document_, take);
    note_repairs(take);
    add_facts(take);
    return take;
  }

 private:
  const FbxTree& tree() const { return document_.tree; }

  Error no_joints() const {
    return Error(
        ErrorKind::unreadable_input,
        fmt::format("{}: holds no joints: none of its {} models is a limb, and none has curves",
                    tree().name, document_.scene.models.size()));
  }

  void note(std::string_view kind, std::string_view message, std::size_t count) {
    note_repair(tree().name, options_.strict, *diagnostics_, kind, message, count);
  }

  std::vector<std::string> stack_names() const {
    std::vector<std::string> names;
    for (const FbxStack& stack : document_.scene.stacks) names.push_back(stack.name);
    return names;
  }

  void choose_stack() {
    const std::vector<FbxStack>& stacks = document_.scene.stacks;
    const bool is_asked = !options_.animation.empty();
    const std::string& wanted = is_asked ? options_.animation : document_.scene.active_stack;
    const auto named = std::find_if(stacks.begin(), stacks.end(),
                                    [&](const FbxStack& stack) { return stack.name == wanted; });
    if (is_asked && named == stacks.end()) {
      throw Error(
          ErrorKind::usage,
          fmt::format("{}: has no animation {}; it has {}", tree().name, quote(wanted),
                      stacks.empty() ? "none" : fmt::format("{}", fmt::join(stack_names(), ", "))));
    }
    if (named != stacks.end() && (take_stack(*named) || is_asked)) return;
    const FbxStack* whole = named != stacks.end() ? &*named : nullptr;
    for (std::size_t i = 0; i < std::min(stacks.size(), tried_stacks); ++i) {
      const std::optional<bool> moves = try_stack(stacks[i]);
      if (moves.value_or(false)) return;
      if (whole == nullptr && moves) whole = &stacks[i];
    }
    // No take has motion: use the take that the file names, else the first that can be read.
    if (!stacks.empty()) take_stack(whole != nullptr ? *whole : stacks.front());
  }

  // `take_stack` for a take that the user did not request; returns empty for a damaged take.
  std::optional<bool> try_stack(const FbxStack& stack) {
    try {
      return take_stack(stack);
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  // Returns whether the take moves a joint.
  bool take_stack(const FbxStack& stack) {
    document_.stack = stack;
    document_.motion = read_fbx_motion(tree(), document_.scene, stack);
    const FbxRig rig =
        choose_fbx_rig(tree(), document_.scene, document_.motion, options_.max_depth);
    return moves_joints(document_.motion, rig);
  }

  // Values that are not finite are held from the key before, else from the next.
  void mend_curves() {
    for (std::size_t c = 0; c < document_.motion.curves.size(); ++c) {
      std::vector<double>& values = document_.motion.curves[c].values;
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (is_missing(values[k])) document_.mended.push_back({c, k});
      }
      hold_missing(values, 0, 1, 0.0);
    }
  }

  void find_frames() {
    const FbxRig& rig = document_.rig;
    const std::size_t frame_bytes = rig.nodes.size() * (sizeof(Quat) + sizeof(Vec3) + 1);
    document_.frames = find_fbx_frames(
        tree(), document_.scene, document_.motion, fbx_joint_curves(document_.motion, rig),
        std::max<std::size_t>(memory_limit(tree().bytes.size()) / frame_bytes, 1));
  }

  void note_repairs(const Take& take) {
    note("value_not_finite", "a key is not a finite number: held from a neighbouring key",
         document_.mended.size());
    note("keys_resampled",
         fmt::format("curves without a key in each frame are sampled at {:.6g} Hz",
                     take.frame_rate_hz),
         document_.frames.resampled);
    std::size_t spheric = 0, scaled = 0;
    for (std::size_t j = 0; j < document_.rig.joints.size(); ++j) {
      const FbxRigNode& node = document_.rig.nodes[document_.rig.joints[j]];
      const FbxModel& model = document_.scene.models[node.model];
      if (model.rotation_active && (model.rotation_order < 0 || model.rotation_order > 5))
        ++spheric;
      if (take.has_joints() && j > 0 && take.skeleton.has_position_channels(j) &&
          !node.has_translation_curves)
        ++scaled;
    }
    note("rotation_order_spheric", "rotations of spheric order are read as XYZ", spheric);
    note("scale_moves_joint",
         "scales that change, or differ by axis, move a joint in the frame of its parent", scaled);
  }

  // Returns the program that wrote the file. Names of earlier programs are ignored, because the
  // motion may have been edited since.
  std::string software() const {
    const std::uint32_t header = tree().child(no_fbx_record, "FBXHeaderExtension");
    if (header == no_fbx_record) return {};
    const std::uint32_t info = tree().child(header, "SceneInfo");
    if (info == no_fbx_record) return {};
    std::string vendor, name;
    for_each_fbx_property(tree(), info, [&](const FbxNamedProperty& property) {
      if (property.name == "LastSaved|ApplicationVendor") vendor = property.text();
      if (property.name == "LastSaved|ApplicationName") name = property.text();
    });
    if (vendor.empty() || name.find(vendor) != name.npos) return name;
    return name.empty() ? vendor : vendor + ", " + name;
  }

  void add_facts(Take& take) const {
    const auto fact = [&](const char* name, const std::string& text) {
      take.source.facts.push_back({name, printable(text)});
    };
    if (!document_.scene.stacks.empty())
      fact("animations",
           fmt::format("{}; this is {}", fmt::join(stack_names(), ", "), document_.stack.name));
    take.source.animations = stack_names();
    take.source.animation = document_.stack.name;
    const std::size_t others = document_.scene.models.size() - document_.rig.joints.size();
    if (others > 0) fact("other models", fmt::format("{}", others));
    if (document_.motion.layers.size() > 1)
      fact("layers", fmt::format("{}", document_.motion.layers.size()));
    if (const std::string writer = software(); !writer.empty()) fact("software", writer);
  }

  FbxDocument& document_;
  const ReadOptions& options_;
  Diagnostics* diagnostics_ = nullptr;
};

// Writes the file with new keys in the curves of changed joints; `original` is
// `take_of_fbx(document)`. Changes that no curve can hold are left out: translations and rotations
// of axes without a curve. Errors: `usage` for a curve that moves several axes or models, and for a
// joint that several layers move.
class FbxRewriter {
 public:
  FbxRewriter(const Take& take, const FbxDocument& document, const Take& original)
      : take_(take),
        document_(document),
        original_(original),
        same_frames_(take.frame_count() == original.frame_count() &&
                     take.frame_rate_hz == original.frame_rate_hz),
        uses_(document.motion.curves.size()),
        changed_(document.motion.curves.size()) {
    for (const FbxLayer& layer : document.motion.layers) {
      for (const auto& [key, vector] : layer.vectors) {
        for (const std::int32_t curve : vector.curves) {
          if (curve >= 0) ++uses_[static_cast<std::size_t>(curve)];
        }
      }
    }
  }

  std::string write() {
    if (is_unchanged()) return document_.tree.bytes;
    find_times();
    for (const FbxMendedKey& key : document_.mended) mended_.push_back(key.curve);
    const std::size_t owners =
        take_.has_joints() ? document_.rig.joints.size() : take_.marker_count();
    sample_source();
    for_each_first_error(owners, [&](std::size_t j) {
      if (take_.has_joints()) turn(j);
      move(j);
    });
    patch_curves();
    if (!same_frames_) patch_range();
    return write_patched_fbx(document_.tree, std::move(patches_));
  }

 private:
  const FbxRigNode& node(std::size_t joint) const {
    return document_.rig.nodes[document_.rig.joints[joint]];
  }
  std::size_t frames() const { return take_.frame_count(); }

  bool is_unchanged() const {
    return same_frames_ && document_.mended.empty() && take_.rotations == original_.rotations &&
           take_.positions == original_.positions && take_.observed == original_.observed;
  }

  void find_times() {
    const std::vector<std::int64_t>& known = document_.frames.times;
    const double step = document_.scene.ticks_per_second / take_.frame_rate_hz;
    const bool same_rate = take_.frame_rate_hz == original_.frame_rate_hz;
    for (std::size_t f = 0; f < frames(); ++f) {
      if (same_rate && f < known.size()) {
        times_.push_back(known[f]);
        continue;
      }
      const std::size_t from = same_rate ? known.size() - 1 : 0;
      times_.push_back(known[from] + static_cast<std::int64_t>(
                                         std::llround(static_cast<double>(f - from) * step)));
    }
  }

  // Computes angles and translations, and the reference frames of translations, at each frame of
  // the source.
  void sample_source() {
    const std::size_t joints = document_.rig.joints.size();
    const std::size_t count = same_frames_ ? frames() : 1;
    angles_.resize(count * joints);
    translations_.resize(count * joints);
    for_each_range(0, count, fbx_frames_a_range,
                   [&](std::size_t first, std::size_t last) { sample_frames(first, last); });
    FbxPoser poser(document_.scene, document_.motion, document_.rig);
    const std::vector<FbxNodePose>& poses = poser.at(document_.frames.times.front());
    for (std::size_t j = 0; j < joints; ++j) bases_.push_back(base_of(poses, j));
  }

  void sample_frames(std::size_t first, std::size_t last) {
    FbxPoser poser(document_.scene, document_.motion, document_.rig);
    const std::span<const std::int64_t> times = document_.frames.times;
    const std::size_t joints = document_.rig.joints.size();
    std::vector<Vec3> local(last - first);
    for (std::size_t j = 0; j < joints; ++j) {
      for (const FbxVector vector : {fbx_translation, fbx_rotation}) {
        poser.locals_over(document_.rig.joints[j], vector, times.subspan(first, last - first),
                          local);
        std::vector<Vec3>& all = vector == fbx_rotation ? angles_ : translations_;
        for (std::size_t f = first; f < last; ++f) all[f * joints + j] = local[f - first];
      }
    }
  }

  // Returns the matrix that converts a step of a joint's position, in the frame of the joint above,
  // to a step of its translation.
  FbxMatrix base_of(const std::vector<FbxNodePose>& poses, std::size_t joint) const {
    FbxMatrix inverse;
    const FbxMatrix step = fbx_step_matrix(document_.rig, poses, node(joint));
    if (!invert_fbx_matrix(step, inverse)) inverse.rows = {};
    return inverse;
  }

  Vec3 source_angles(std::size_t frame, std::size_t joint) const {
    return angles_[(same_frames_ ? frame : 0) * document_.rig.joints.size() + joint];
  }
  Vec3 source_translation(std::size_t frame, std::size_t joint) const {
    return translations_[(same_frames_ ? frame : 0) * document_.rig.joints.size() + joint];
  }

  // Returns the curves of a vector of a joint, or null. Only curves of the first layer, without
  // other layers, hold the value itself.
  const FbxAnimatedVector* curves_of(std::size_t joint, FbxVector vector) const {
    const FbxAnimatedVector* found = nullptr;
    std::size_t layers = 0;
    bool is_plain = true;
    for (const FbxLayer& layer : document_.motion.layers) {
      const FbxAnimatedVector* const entry = layer.find(node(joint).model, vector);
      if (entry == nullptr) continue;
      ++layers;
      found = entry;
      is_plain = &layer == &document_.motion.layers.front() && !layer.is_muted;
    }
    if (layers > 1 || !is_plain) {
      throw Error(ErrorKind::usage,
                  fmt::format("{}: {} of {} layers move {}; merge the layers into one to change it",
                              take_.source.name, layers, document_.motion.layers.size(),
                              quote(name_of(joint))));
    }
    return found;
  }

  const std::string& name_of(std::size_t joint) const {
    return document_.scene.models[node(joint).model].name;
  }

  void set(const FbxAnimatedVector& vector, std::size_t axis, std::size_t joint, std::size_t frame,
           double value) {
    if (vector.curves[axis] < 0) return;
    const auto curve = static_cast<std::size_t>(vector.curves[axis]);
    if (uses_[curve] > 1) {
      throw Error(ErrorKind::usage,
                  fmt::format("{}: a curve of {} moves something else too, so it cannot be changed",
                              take_.source.name, quote(name_of(joint))));
    }
    changed_[curve].resize(frames());
    changed_[curve][frame] = value;
  }

  void turn(std::size_t joint) {
    const FbxRigNode& each = node(joint);
    if (each.first_turn == each.end_turn || !turns_differ(joint)) return;
    const FbxAnimatedVector* const vector = curves_of(joint, fbx_rotation);
    if (vector == nullptr) return;
    RotationOrder order;
    std::array<double, 3> near{};
    for (std::size_t i = each.first_turn; i < each.end_turn; ++i) {
      near[order.count] =
          radians_per_degree *
          component(source_angles(0, joint), static_cast<std::size_t>(each.order.axes[i]));
      order.axes[order.count++] = each.order.axes[i];
    }
    for (std::size_t f = 0; f < frames(); ++f) {
      const bool is_same = same_frames_ && take_.rotation(f, joint) == original_.rotation(f, joint);
      if (!is_same) near = to_euler_near(take_.rotation(f, joint), order, near);
      for (std::size_t i = 0; i < order.count; ++i) {
        const auto axis = static_cast<std::size_t>(order.axes[i]);
        const double source = component(source_angles(f, joint), axis);
        if (is_same) near[i] = radians_per_degree * source;
        set(*vector, axis, joint, f, is_same ? source : near[i] / radians_per_degree);
      }
    }
  }

  bool turns_differ(std::size_t joint) const {
    if (!same_frames_) return true;
    for (std::size_t f = 0; f < frames(); ++f) {
      if (!(take_.rotation(f, joint) == original_.rotation(f, joint))) return true;
    }
    return false;
  }

  // Returns the point of the takes that is the position of a joint or marker; none if it has none.
  std::optional<std::size_t> point_of(std::size_t joint) const {
    return take_.has_joints() ? point_of_joint(take_, joint) : joint;
  }

  Vec3 position(std::size_t frame, std::size_t point) const {
    if (take_.has_joints() || take_.is_observed(frame, point)) return take_.position(frame, point);
    // A missing sample has the last known position of its marker, or the first.
    for (std::size_t f = frame; f-- > 0;) {
      if (take_.is_observed(f, point)) return take_.position(f, point);
    }
    for (std::size_t f = frame; f < frames(); ++f) {
      if (take_.is_observed(f, point)) return take_.position(f, point);
    }
    return original_.position(0, point);
  }

  void move(std::size_t joint) {
    const std::optional<std::size_t> point = point_of(joint);
    if (!node(joint).has_translation_curves || !point || !moves_differ(*point)) return;
    const FbxAnimatedVector* const vector = curves_of(joint, fbx_translation);
    if (vector == nullptr) return;
    for (std::size_t f = 0; f < frames(); ++f) {
      const std::size_t from = same_frames_ ? f : 0;
      const Vec3 step = position(f, *point) - original_.position(from, *point);
      const Vec3 source = source_translation(f, joint);
      const Vec3 moved = source + bases_[joint] * step;
      // Below a model with a scale near zero, no translation reaches the position.
      const bool is_usable = norm(moved) <= largest_fbx_value;
      for (std::size_t axis = 0; axis < 3; ++axis)
        set(*vector, axis, joint, f, component(is_usable ? moved : source, axis));
    }
  }

  bool moves_differ(std::size_t point) const {
    if (!same_frames_) return true;
    for (std::size_t f = 0; f < frames(); ++f) {
      if (!(position(f, point) == original_.position(f, point))) return true;
    }
    return false;
  }

  void patch_curves() {
    std::vector<std::vector<FbxPatch>> patches(changed_.size());
    for_each_first_error(changed_.size(), [&](std::size_t c) { patch_curve(c, patches[c]); });
    for (std::vector<FbxPatch>& some : patches)
      std::move(some.begin(), some.end(), std::back_inserter(patches_));
  }

  void patch_curve(std::size_t c, std::vector<FbxPatch>& patches) const {
    const FbxCurve& curve = document_.motion.curves[c];
    const bool was_mended = std::count(mended_.begin(), mended_.end(), c) > 0;
    if (!changed_[c].empty() && !stays(curve, changed_[c])) {
      if (same_frames_ && is_baked(curve, document_.frames)) {
        patch_fbx_values(document_.tree, as_in_file(curve, c), changed_[c], patches);
      } else {
        bake_fbx_curve(document_.tree, curve, times_, changed_[c], patches);
      }
    } else if (was_mended) {
      patch_fbx_values(document_.tree, as_in_file(curve, c), curve.values, patches);
    }
  }

  // Returns the curve with its values before repair, so that repaired values are written.
  FbxCurve as_in_file(const FbxCurve& curve, std::size_t index) const {
    FbxCurve copy = curve;
    for (const FbxMendedKey& key : document_.mended) {
      if (key.curve == index) copy.values[key.key] = std::nan("");
    }
    return copy;
  }

  // Whether a curve already has these values, to the precision of the file.
  bool stays(const FbxCurve& curve, const std::vector<double>& values) const {
    if (!same_frames_ && !curve.is_constant()) return false;
    std::size_t cursor = 0;
    for (std::size_t f = 0; f < values.size(); ++f) {
      const double now = fbx_value_at(curve, times_[f], document_.scene.ticks_per_second, cursor);
      if (static_cast<float>(now) != static_cast<float>(values[f])) return false;
    }
    return true;
  }

  // Moves the stated end of the animation to the last frame.
  void patch_range() {
    const FbxTree& tree = document_.tree;
    if (document_.scene.stacks.empty() || document_.motion.curves.empty()) return;
    const auto set_time = [&](const FbxProperty* property) {
      if (property != nullptr && fbx_integer(tree, *property))
        patches_.push_back(fbx_integer_patch(tree, *property, times_.back()));
    };
    for_each_fbx_property(tree, document_.stack.record, [&](const FbxNamedProperty& p) {
      if (p.name == "LocalStop" || p.name == "ReferenceStop") set_time(p.value(0));
    });
    tree.for_each_child(tree.child(no_fbx_record, "Takes"), [&](std::uint32_t take) {
      const FbxProperty* const name = tree.property(tree.records[take], 0);
      if (name == nullptr || fbx_text(tree, *name) != document_.stack.name) return;
      for (const std::string_view range : {"LocalTime", "ReferenceTime"}) {
        const std::uint32_t record = tree.child(take, range);
        if (record != no_fbx_record) set_time(tree.property(tree.records[record], 1));
      }
    });
  }

  const Take& take_;
  const FbxDocument& document_;
  const Take& original_;
  bool same_frames_;
  std::vector<std::size_t> uses_;             // by curve: the number of axes it moves
  std::vector<std::vector<double>> changed_;  // by curve: its value in each frame
  std::vector<std::size_t> mended_;           // repaired curves
  std::vector<std::int64_t> times_;
  std::vector<Vec3> angles_, translations_;  // values of all joints, by frame
  std::vector<FbxMatrix> bases_;
  std::vector<FbxPatch> patches_;
};

bool fits_fbx_document(const Take& take, const FbxDocument& document, const Take& original) {
  return take.frame_count() > 0 && !document.rig.joints.empty() && same_parts(take, original);
}

}  // namespace

int sniff_fbx(std::string_view head) {
  if (is_binary_fbx(head)) return 100;
  head = without_byte_order_mark(head);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == head.npos) return 0;
  head.remove_prefix(first);
  if (head.substr(0, 6) == "; FBX ") return 100;
  return head.find("FBXHeaderExtension:") != head.npos ? 90 : 0;
}

TakeResult read_fbx(std::string bytes, std::string_view name, const ReadOptions& options) {
  const auto document = std::make_shared<FbxDocument>();
  document->tree = read_fbx_tree(std::move(bytes), name, options.max_depth);
  Diagnostics diagnostics;
  Take take = FbxReader(*document, options).read(diagnostics);
  take.source.name = std::string(name);
  take.source.format = "fbx";
  take.source.document = document;
  TakeResult result;
  result.take = std::move(take);
  result.diagnostics = std::move(diagnostics);
  return result;
}

std::vector<std::string> lost_beside_fbx(const Take& take) {
  const auto* const document = dynamic_cast<const FbxDocument*>(take.source.document.get());
  if (document == nullptr) return {};
  const bool joints =
      take.has_joints() && !holds_fbx_markers(document->scene, document->motion, document->rig);
  const Take original = joints ? skeleton_of_fbx(*document) : take_of_fbx(*document);
  if (fits_fbx_document(take, *document, original)) return {};
  std::vector<std::string> parts;
  if (document->scene.models.size() > document->rig.joints.size())
    parts.emplace_back("meshes and other models");
  if (document->scene.stacks.size() > 1) parts.emplace_back("other takes");
  parts.emplace_back("materials and properties");
  return parts;
}

std::string write_fbx(const Take& take) {
  const auto* const document = dynamic_cast<const FbxDocument*>(take.source.document.get());
  if (document == nullptr) return new_fbx_file(take);
  const Take original = take_of_fbx(*document);
  if (!fits_fbx_document(take, *document, original)) return new_fbx_file(take);
  return FbxRewriter(take, *document, original).write();
}

}  // namespace kinemend
