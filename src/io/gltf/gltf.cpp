// Reads glTF: chooses the animation, decodes it, and reports repairs. Writes takes into their
// source file, in its own container or in the other kind and with the separate files, else as a new
// file.
#include "io/gltf/gltf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "io/gltf/gltf_container.hpp"
#include "io/gltf/gltf_json.hpp"
#include "io/gltf/gltf_motion.hpp"
#include "io/gltf/gltf_rewrite.hpp"
#include "io/motion/motion_write.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"

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

void note_gltf_repairs(const GltfDocument& document, const GltfMotion& motion, bool strict,
                       Diagnostics& diagnostics) {
  const auto note = [&](std::string_view kind, std::size_t count, const std::string& message) {
    note_repair(document.file.name, strict, diagnostics, kind, message, count);
  };
  const double rate = motion.take.frame_rate_hz;
  note("matrix_sheared", motion.sheared.empty() ? 0 : 1,
       fmt::format("{}: the matrix shears, which no joint can: left out",
                   first_names(motion.sheared)));
  note(
      "scale_not_uniform", motion.odd_scales.empty() ? 0 : 1,
      fmt::format("{}: turned below axes of different scales, which no joint can be: their mean is "
                  "used for the positions below",
                  first_names(motion.odd_scales)));
  note("channel_repeated", motion.repeated.empty() ? 0 : 1,
       fmt::format("{}: two channels for one thing: the first is read",
                   first_names(motion.repeated)));
  note("value_not_finite", motion.held_keys, "a key is not finite: held from a neighbouring key");
  note("keys_resampled", motion.grid.is_of_keys ? 0 : 1,
       fmt::format("the keys lie on no common frames: read at {:.6g} Hz; a joint that changes is "
                   "written with a key in each frame",
                   rate));
  note("keys_interpolated", motion.grid.is_of_keys && motion.interpolated > 0 ? 1 : 0,
       fmt::format("{} moving channels have no key in some frames: interpolated; a joint that "
                   "changes is written with a key in each frame",
                   motion.interpolated));
  const bool is_assumed = motion.grid.is_assumed && motion.take.frame_count() > 0;
  note("frame_rate_assumed", is_assumed && document.rate_hz == 0 ? 1 : 0,
       fmt::format("a single key tells no rate: {:.6g} Hz", rate));
}

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
  GltfMotion motion = decode_gltf(document->file, document->model, document->buffers,
                                  document->animation, document->rate_hz);
  check_joint_depth(document->file, motion.take.skeleton, options.max_depth);
  note_gltf_repairs(*document, motion, options.strict, result.diagnostics);
  motion.take.source = {std::string(name), format, document, facts_of(*document)};
  name_animations(*document, motion.take.source);
  result.take = std::move(motion.take);
  return result;
}

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  const fs::path parent = file.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

bool is_same_place(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

// Makes the file with its changes, binary or as text. A file without changes keeps its bytes if its
// container is the same. `output`: its path; empty: unknown, so that changed buffers are stored in
// the text. If the path is known, changed buffers in separate files get the name of the output, and
// other separate files are copied to its folder if needed.
class GltfPacker {
 public:
  GltfPacker(const GltfDocument& document, const GltfChanges& changes, bool as_binary,
             const fs::path& output)
      : document_(document),
        file_(document.file),
        changes_(changes),
        as_binary_(as_binary),
        output_(output),
        edits_(changes.edits) {}

  TakeFiles pack() {
    place_buffers();
    copy_beside();
    TakeFiles files;
    files.beside = std::move(beside_);
    const bool same_container = as_binary_ == file_.is_binary;
    if (same_container && edits_.empty() && changes_.buffers.empty()) {
      files.bytes = file_.bytes;
      return files;
    }
    std::string json = edited_json(file_.json_text(), std::move(edits_));
    if (same_container) {
      files.bytes = reassembled_gltf(file_, std::move(json), changed(0));
    } else {
      files.bytes = as_binary_ ? new_glb(json, binary_) : without_padding(std::move(json));
    }
    return files;
  }

 private:
  using Place = GltfBuffer::Place;

  const std::string* changed(std::size_t buffer) const {
    const auto found = changes_.buffers.find(buffer);
    return found == changes_.buffers.end() ? nullptr : &found->second;
  }

  // Removes the chunk's trailing spaces, which belong to the container.
  static std::string without_padding(std::string json) {
    while (json.ends_with(' ')) json.pop_back();
    return json;
  }

  std::string content(std::size_t buffer) const {
    if (const std::string* const bytes = changed(buffer)) return *bytes;
    return load_gltf_buffer(file_, document_.model, buffer);
  }

  void place_buffers() {
    const auto& buffers = document_.model.buffers;
    for (std::size_t b = 0; b < buffers.size(); ++b) {
      const bool in_chunk = buffers[b].place == Place::binary_chunk;
      if (as_binary_ && !file_.is_binary && b == 0 && buffers[b].place != Place::unknown &&
          remove_uri(b)) {
        binary_ = content(b);
        if (changed(b) == nullptr) binary_.resize(std::min(binary_.size(), buffers[b].size));
        first_moves_ = true;
      } else if (in_chunk && !as_binary_) {
        set_uri(b, data_uri(b));
      } else if (!in_chunk && changed(b) != nullptr) {
        place_changed(b);
      }
    }
  }

  std::string data_uri(std::size_t buffer) const {
    const std::string_view text = file_.json_text();
    const auto element = json_element(text, "buffers", buffer);
    const auto uri = element ? json_member(text, *element, "uri") : std::nullopt;
    const std::string_view old = uri ? text.substr(uri->begin + 1, uri->size - 2) : "";
    const std::string_view head = is_data_uri(old) ? old.substr(0, old.find(',') + 1)
                                                   : "data:application/octet-stream;base64,";
    return std::string(head) + base64(content(buffer));
  }

  void place_changed(std::size_t buffer) {
    if (document_.model.buffers[buffer].place != Place::beside || output_.empty())
      return set_uri(buffer, data_uri(buffer));
    const std::string name = free_name();
    set_uri(buffer, uri_of_file_name(name));
    beside_.push_back({output_.parent_path() / name, *changed(buffer)});
  }

  // Returns a file name based on the output's; never a file that the source needs, unless the
  // output replaces the source.
  std::string free_name() const {
    const std::string stem = output_.stem().string();
    const bool replaces = is_same_place(output_, file_.name);
    for (std::size_t number = 1;; ++number) {
      std::string name = number == 1 ? stem + ".bin" : fmt::format("{}_{}.bin", stem, number);
      const fs::path place = output_.parent_path() / name;
      const bool is_new = std::none_of(beside_.begin(), beside_.end(),
                                       [&](const SideFile& file) { return file.path == place; });
      if (is_new && (replaces || !is_needed_by_source(place))) return name;
    }
  }

  bool is_needed_by_source(const fs::path& place) const {
    const fs::path folder = folder_of(file_.name);
    const auto is_it = [&](const std::string& path) {
      return !path.empty() && is_same_place(folder / path, place);
    };
    const auto& buffers = document_.model.buffers;
    const auto& images = document_.model.image_paths;
    return std::any_of(buffers.begin(), buffers.end(),
                       [&](const GltfBuffer& buffer) { return is_it(buffer.path); }) ||
           std::any_of(images.begin(), images.end(), is_it);
  }

  // Copies the separate files of the source that the output names.
  void copy_beside() {
    if (output_.empty() || is_same_place(folder_of(output_), folder_of(file_.name))) return;
    std::vector<std::string> paths = document_.model.image_paths;
    const auto& buffers = document_.model.buffers;
    for (std::size_t b = 0; b < buffers.size(); ++b) {
      const bool stays = changed(b) == nullptr && !(first_moves_ && b == 0);
      if (buffers[b].place == Place::beside && !buffers[b].path.empty() && stays)
        paths.push_back(buffers[b].path);
    }
    std::sort(paths.begin(), paths.end());
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    for (const std::string& path : paths) {
      const fs::path from = folder_of(file_.name) / path;
      std::error_code ignored;
      if (fs::is_regular_file(from, ignored))
        beside_.push_back({output_.parent_path() / path, read_file(from)});
    }
  }

  void set_uri(std::size_t buffer, const std::string& uri) {
    const auto object = json_element(file_.json_text(), "buffers", buffer);
    if (!object) return;
    const auto old = json_member(file_.json_text(), *object, "uri");
    if (old) {
      edits_.push_back({*old, "\"" + uri + "\""});
    } else {
      edits_.push_back({{object->begin + 1, 0}, "\"uri\":\"" + uri + "\","});
    }
  }

  // Removes the member with its comma.
  bool remove_uri(std::size_t buffer) {
    const std::string_view text = file_.json_text();
    const auto object = json_element(file_.json_text(), "buffers", buffer);
    const auto member = object ? json_named_member(text, *object, "uri") : std::nullopt;
    if (!member) return false;
    constexpr std::string_view blanks = " \t\r\n";
    std::size_t begin = member->whole().begin, end = begin + member->whole().size;
    const std::size_t next = text.find_first_not_of(blanks, end);
    const std::size_t before = text.find_last_not_of(blanks, begin - 1);
    if (next != text.npos && text[next] == ',') {
      end = next + 1;
    } else if (before != text.npos && text[before] == ',') {
      begin = before;
    }
    edits_.push_back({{begin, end - begin}, ""});
    return true;
  }

  const GltfDocument& document_;
  const GltfFile& file_;
  const GltfChanges& changes_;
  bool as_binary_;
  const fs::path& output_;
  std::vector<JsonEdit> edits_;
  std::vector<SideFile> beside_;
  std::string binary_;
  bool first_moves_ = false;  // whether buffer 0 becomes the chunk of a binary file
};

const GltfDocument* gltf_document_of(const Take& take) {
  return dynamic_cast<const GltfDocument*>(take.source.document.get());
}

// Converts a new binary file to text, with its chunk inline.
std::string text_of_glb(std::string bytes) {
  GltfDocument document;
  Diagnostics none;
  document.file = open_gltf(std::move(bytes), "new file", false, none);
  document.model = parse_gltf(document.file);
  return GltfPacker(document, {}, false, {}).pack().bytes;
}

TakeFiles files_in_container(const Take& take, bool as_binary,
                             const std::filesystem::path& output) {
  take.validate();
  if (const GltfDocument* const document = gltf_document_of(take)) {
    const GltfMotion motion = document->motion();
    if (same_parts(take, motion.take)) {
      const GltfChanges changes = changes_of_gltf(take, *document, motion);
      return GltfPacker(*document, changes, as_binary, output).pack();
    }
  }
  std::string bytes = new_glb_of(take);
  return {as_binary ? std::move(bytes) : text_of_glb(std::move(bytes)), {}};
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

TakeFiles glb_files_of_take(const Take& take, const std::filesystem::path& output) {
  return files_in_container(take, true, output);
}

TakeFiles gltf_files_of_take(const Take& take, const std::filesystem::path& output) {
  return files_in_container(take, false, output);
}

std::vector<std::string> lost_beside_gltf(const Take& take) {
  const GltfDocument* const document = gltf_document_of(take);
  if (document == nullptr || same_parts(take, document->motion().take)) return {};
  std::vector<std::string> parts;
  if (document->model.meshes > 0) parts.emplace_back("meshes");
  if (!document->model.skins.empty()) parts.emplace_back("skins");
  if (document->model.animations.size() > 1) parts.emplace_back("other animations");
  parts.emplace_back("other nodes and properties");
  return parts;
}

std::string write_glb(const Take& take) { return glb_files_of_take(take, {}).bytes; }
std::string write_gltf(const Take& take) { return gltf_files_of_take(take, {}).bytes; }

}  // namespace kinemend
