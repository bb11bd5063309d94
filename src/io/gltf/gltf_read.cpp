// Reads glTF: chooses the animation, decodes it, and reports repairs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/text.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/gltf_motion.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

std::string animation_list(const GltfModel& model) {
  // Chosen by hand.
  constexpr std::size_t most_named = 20;
  std::vector<std::string> names;
  for (std::size_t a = 0; a < model.animations.size() && a < most_named; ++a)
    names.push_back(quote(name_of_animation(model, a)));
  if (model.animations.size() > most_named)
    names.push_back(fmt::format("and {} more", model.animations.size() - most_named));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// Whether the animation rotates or moves a joint or a marker.
bool moves_something(const GltfModel& model, std::size_t animation,
                     const std::vector<std::size_t>& joints) {
  std::vector<std::uint8_t> is_joint(model.nodes.size());
  for (const std::size_t node : joints) is_joint[node] = 1;
  const auto& channels = model.animations[animation].channels;
  return std::any_of(channels.begin(), channels.end(), [&](const GltfChannel& channel) {
    return (channel.path == GltfPath::translation || channel.path == GltfPath::rotation) &&
           channel.node >= 0 && is_joint[static_cast<std::size_t>(channel.node)] != 0;
  });
}

std::size_t named_animation(const GltfFile& file, const GltfModel& model, std::string_view name) {
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    if (name_of_animation(model, a) == name) return a;
  }
  throw Error(ErrorKind::usage, fmt::format("{}: no animation is called {}; there are: {}",
                                            file.name, quote(name), animation_list(model)));
}

// Chooses the animation by name, else the first that moves a joint; `none` for a skin without
// motion.
std::size_t chosen_animation(const GltfFile& file, const GltfModel& model, std::string_view name) {
  const bool is_named = !name.empty();
  const std::size_t first = is_named ? named_animation(file, model, name) : 0;
  const std::size_t last = is_named ? first + 1 : model.animations.size();
  const bool has_skin = !model.skins.empty();
  std::size_t looked_at = 0;
  // Limits the time; chosen by hand.
  constexpr std::size_t most_looked_at = std::size_t{1} << 26;  // nodes
  for (std::size_t a = first; a < last && looked_at < most_looked_at; ++a) {
    if (moves_something(model, a, gltf_joints(model, a))) return a;
    looked_at += 8 * model.nodes.size();
  }
  if (has_skin && !is_named) return GltfTrack::none;
  if (is_named || !model.animations.empty()) {
    throw Error::at_byte(
        file.name, file.json.begin,
        fmt::format("no joint is turned or moved by {}; the animations are: {}",
                    is_named ? quote(name) : "any animation", animation_list(model)));
  }
  throw Error::at_byte(file.name, file.json.begin,
                       "the scene has neither an animation nor a skin: there is no motion in it");
}

std::string first_names(const std::vector<std::string>& names) {
  // Chosen by hand.
  constexpr std::size_t most_named = 5;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < most_named; ++i)
    text += (i == 0 ? "" : ", ") + quote(names[i]);
  if (names.size() > most_named) text += fmt::format(" and {} more", names.size() - most_named);
  return text;
}

class GltfNotes {
 public:
  GltfNotes(const GltfDocument& document, bool strict, Diagnostics& diagnostics)
      : document_(document), strict_(strict), diagnostics_(diagnostics) {}

  void about(const GltfMotion& motion) {
    if (!motion.sheared.empty())
      note("matrix_sheared", fmt::format("{}: the matrix shears, which no joint can: left out",
                                         first_names(motion.sheared)));
    if (!motion.odd_scales.empty()) {
      note("scale_not_uniform",
           fmt::format("{}: turned below axes of different scales, which no joint can be: their "
                       "mean is used for the positions below",
                       first_names(motion.odd_scales)));
    }
    if (!motion.repeated.empty())
      note("channel_repeated", fmt::format("{}: two channels for one thing: the first is read",
                                           first_names(motion.repeated)));
    about_keys(motion);
  }

 private:
  void note(std::string_view kind, const std::string& message) {
    note_gltf_repair(document_.file.name, strict_, diagnostics_, kind, message);
  }

  void about_keys(const GltfMotion& motion) {
    const double rate = motion.take.frame_rate_hz;
    if (motion.held_keys > 0) {
      for (std::size_t i = 0; i < motion.held_keys; ++i)
        note("value_not_finite", "a key is not finite: held from a neighbouring key");
    }
    if (!motion.grid.is_of_keys) {
      note("keys_resampled",
           fmt::format("the keys lie on no common frames: read at {:.6g} Hz; a joint that changes "
                       "is written with a key in each frame",
                       rate));
    } else if (motion.interpolated > 0) {
      note("keys_interpolated",
           fmt::format("{} moving channels have no key in some frames: interpolated; a joint that "
                       "changes is written with a key in each frame",
                       motion.interpolated));
    }
    if (motion.grid.is_assumed && motion.take.frame_count() > 0 && document_.rate_hz == 0)
      note("frame_rate_assumed", fmt::format("a single key tells no rate: {:.6g} Hz", rate));
  }

  const GltfDocument& document_;
  bool strict_;
  Diagnostics& diagnostics_;
};

std::vector<SourceFact> facts_of(const GltfDocument& document) {
  const GltfModel& model = document.model;
  std::vector<SourceFact> facts;
  if (!model.generator.empty()) facts.push_back({"software", model.generator});
  if (document.animation != GltfTrack::none) {
    facts.push_back(
        {"animations", fmt::format("{}; read: {}", animation_list(model),
                                   quote(name_of_animation(model, document.animation)))});
  }
  if (!model.skins.empty()) facts.push_back({"skins", std::to_string(model.skins.size())});
  if (model.meshes > 0) facts.push_back({"meshes", std::to_string(model.meshes)});
  return facts;
}

// Lists the animations that move the same joints as the one that was read.
void name_animations(const GltfDocument& document, SourceInfo& source) {
  const GltfModel& model = document.model;
  if (document.animation == GltfTrack::none) return;
  const std::vector<std::size_t> joints = gltf_joints(model, document.animation);
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    if (moves_something(model, a, joints)) source.animations.push_back(name_of_animation(model, a));
  }
  source.animation = name_of_animation(model, document.animation);
}

void check_joint_depth(const GltfFile& file, const Skeleton& skeleton, std::size_t most) {
  std::vector<std::size_t> depths;
  for (const std::int32_t parent : skeleton.parents) {
    depths.push_back(parent < 0 ? 1 : depths[static_cast<std::size_t>(parent)] + 1);
    if (depths.back() <= most) continue;
    throw Error::at_byte(file.name, file.json.begin,
                         fmt::format("joints are nested more than {} deep", most));
  }
}

TakeResult read_gltf_file(std::string bytes, std::string_view name, const ReadOptions& options,
                          const char* format) {
  TakeResult result;
  const auto document = std::make_shared<GltfDocument>();
  document->file = open_gltf(std::move(bytes), name, options.strict, result.diagnostics);
  document->model = parse_gltf(document->file);
  document->rate_hz = options.frame_rate_hz;
  document->animation = chosen_animation(document->file, document->model, options.animation);
  document->has_markers = !gltf_markers(document->model, document->animation).empty();
  const auto decode = document->has_markers ? &decode_gltf_markers : &decode_gltf_joints;
  GltfMotion motion = decode(document->file, document->model, document->buffers,
                             document->animation, document->rate_hz);
  check_joint_depth(document->file, motion.take.skeleton, options.max_depth);
  GltfNotes(*document, options.strict, result.diagnostics).about(motion);
  motion.take.source = {std::string(name), format, document, facts_of(*document)};
  name_animations(*document, motion.take.source);
  result.take = std::move(motion.take);
  return result;
}

}  // namespace

int sniff_glb(std::string_view head) { return head.substr(0, 4) == "glTF" ? 100 : 0; }

int sniff_gltf(std::string_view head) {
  head = without_byte_order_mark(head);
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  if (begin == head.npos || head[begin] != '{') return 0;
  for (const char* const word : {"\"asset\"", "\"accessors\"", "\"bufferViews\"", "\"animations\"",
                                 "\"scenes\"", "\"extensionsUsed\"", "\"buffers\""}) {
    if (head.find(word) != head.npos) return 90;
  }
  return 0;
}

TakeResult read_glb(std::string bytes, std::string_view name, const ReadOptions& options) {
  if (!std::string_view(bytes).starts_with("glTF"))
    throw Error::at_byte(name, 0, "no binary glTF: the file does not begin with glTF");
  return read_gltf_file(std::move(bytes), name, options, "glb");
}

TakeResult read_gltf(std::string bytes, std::string_view name, const ReadOptions& options) {
  if (std::string_view(bytes).starts_with("glTF"))
    throw Error::at_byte(name, 0, "binary glTF, not its text");
  return read_gltf_file(std::move(bytes), name, options, "gltf");
}

}  // namespace kinemend
