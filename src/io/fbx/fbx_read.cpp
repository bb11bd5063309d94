// Reads FBX files as takes of joints, or as takes of markers if they hold only points.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "io/fbx/fbx.hpp"
#include "io/fbx/fbx_document.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/reading_limits.hpp"
#include "kinemend/extend/text.hpp"

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
    if (count == 0) return;
    if (options_.strict) {
      throw Error(ErrorKind::quality_limit, fmt::format("{}: {}", tree().name, message));
    }
    for (std::size_t i = 0; i < count; ++i) diagnostics_->add(kind, message);
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
      const auto known = std::find_if(values.begin(), values.end(),
                                      [](double value) { return !std::isnan(value); });
      double last = known == values.end() ? 0 : *known;
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isnan(values[k])) {
          document_.mended.push_back({c, k});
          values[k] = last;
        }
        last = values[k];
      }
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

}  // namespace kinemend
