// Writes new entries as JSON, and appends their floats to a buffer.
#include "io/gltf/gltf_additions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

constexpr int added_component = 5126;  // floats
constexpr std::size_t added_alignment = 4;

std::size_t home_of(const GltfDocument& document) {
  for (const GltfSampler& sampler : document.model.animations[document.animation].samplers) {
    const auto view = document.model.accessors[sampler.output].view;
    if (!view || *view >= document.model.views.size()) continue;
    const std::size_t buffer = document.model.views[*view].buffer;
    if (document.buffers.is_loaded(buffer)) return buffer;
  }
  throw Error(ErrorKind::usage, fmt::format("{}: no buffer holds keys of the animation, so none "
                                            "can be added",
                                            document.file.name));
}

const char* name_of(GltfPath path) {
  if (path == GltfPath::rotation) return "rotation";
  return path == GltfPath::scale ? "scale" : "translation";
}

}  // namespace

std::string json_of_float(float value) { return fmt::format("{}", value); }

GltfAdditions::GltfAdditions(const GltfDocument& document, GltfChanges& changes)
    : document_(document), changes_(changes) {
  const GltfAnimation& animation = document.model.animations[document.animation];
  views_.before = document.model.views.size();
  accessors_.before = document.model.accessors.size();
  samplers_.before = animation.samplers.size();
  channels_.before = animation.channels.size();
}

std::string& GltfAdditions::buffer() {
  if (views_.items.empty()) home_ = home_of(document_);
  const auto found = changes_.buffers.find(home_);
  if (found != changes_.buffers.end()) return found->second;
  return changes_.buffers
      .emplace(home_, std::string(document_.buffers.bytes(document_.file, home_)))
      .first->second;
}

std::size_t GltfAdditions::add_floats(const std::vector<double>& values, std::size_t width,
                                      bool are_times) {
  std::string& bytes = buffer();
  bytes.append((added_alignment - bytes.size() % added_alignment) % added_alignment, '\0');
  const std::size_t begin = bytes.size();
  for (const double value : values) {
    std::array<char, sizeof(float)> stored{};
    if (!store_component(value, added_component, false, stored.data()))
      throw Error(ErrorKind::usage, "a number is too large for a glTF file");
    bytes.append(stored.data(), stored.size());
  }
  const std::size_t view = views_.add(fmt::format(
      "{{\"buffer\":{},\"byteOffset\":{},\"byteLength\":{}}}", home_, begin, bytes.size() - begin));
  std::string range;
  if (are_times && !values.empty()) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    range = fmt::format(",\"min\":[{}],\"max\":[{}]", json_of_float(static_cast<float>(*least)),
                        json_of_float(static_cast<float>(*most)));
  }
  const char* const type = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
  return accessors_.add(
      fmt::format("{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}", view,
                  added_component, values.size() / width, type, range));
}

std::size_t GltfAdditions::add_sampler(std::size_t input, std::size_t output, bool in_steps) {
  return samplers_.add(fmt::format("{{\"input\":{},\"output\":{},\"interpolation\":\"{}\"}}", input,
                                   output, in_steps ? "STEP" : "LINEAR"));
}

void GltfAdditions::set_sampler(std::size_t channel, std::size_t sampler) {
  set_samplers_.emplace_back(channel, sampler);
}

void GltfAdditions::add_channel(std::size_t node, GltfPath path, std::size_t sampler) {
  if (document_.model.nodes[node].has_matrix) split_matrix(node);
  channels_.add(fmt::format("{{\"sampler\":{},\"target\":{{\"node\":{},\"path\":\"{}\"}}}}",
                            sampler, node, name_of(path)));
}

void GltfAdditions::split_matrix(std::size_t node) {
  if (!split_.insert(node).second) return;
  const std::string_view text = document_.file.json_text();
  const auto object = json_element(text, "nodes", node);
  const auto matrix = object ? json_named_member(text, *object, "matrix") : std::nullopt;
  if (!matrix) return;
  const GltfNode& n = document_.model.nodes[node];
  changes_.edits.push_back(
      {matrix->whole(),
       fmt::format("\"translation\":[{},{},{}],\"rotation\":[{},{},{},{}],\"scale\":[{},{},{}]",
                   n.translation.x, n.translation.y, n.translation.z, n.rotation.x, n.rotation.y,
                   n.rotation.z, n.rotation.w, n.scale.x, n.scale.y, n.scale.z)});
}

void GltfAdditions::append(std::optional<ByteSpan> array, const Additions& additions) {
  if (additions.items.empty()) return;
  if (!array || array->size < 2) {
    throw Error(ErrorKind::usage, fmt::format("{}: an array that keys are added to is not there",
                                              document_.file.name));
  }
  std::string text;
  bool follows_another = additions.before > 0;
  for (const std::string& item : additions.items) {
    if (follows_another) text += ',';
    text += item;
    follows_another = true;
  }
  changes_.edits.push_back({{array->begin + array->size - 1, 0}, std::move(text)});
}

void GltfAdditions::finish() {
  const std::string_view text = document_.file.json_text();
  append(json_member(text, {"bufferViews"}), views_);
  append(json_member(text, {"accessors"}), accessors_);
  const auto animation = json_element(text, "animations", document_.animation);
  const auto member = [&](const char* key) {
    return animation ? json_member(text, *animation, key) : std::nullopt;
  };
  append(member("samplers"), samplers_);
  append(member("channels"), channels_);
  const auto channels = member("channels");
  const auto elements = channels ? json_elements(text, *channels) : std::vector<ByteSpan>{};
  for (const auto& [channel, sampler] : set_samplers_) {
    const auto place = json_member(text, elements.at(channel), "sampler");
    if (place) changes_.edits.push_back({*place, std::to_string(sampler)});
  }
  if (views_.items.empty()) return;
  const auto grown = json_element(text, "buffers", home_);
  const auto length = grown ? json_member(text, *grown, "byteLength") : std::nullopt;
  if (length) changes_.edits.push_back({*length, std::to_string(changes_.buffers[home_].size())});
}

}  // namespace kinemend
