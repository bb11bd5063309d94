// Parses the JSON of a glTF file, and splits matrices into translation, rotation and scale.
#include "io/gltf/gltf_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/gltf/gltf_container.hpp"
#include "io/gltf/gltf_json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// Far above real scenes; limits the memory of hostile files. Chosen by hand.
constexpr std::size_t most_gltf_nodes = 65536, most_gltf_elements = 131072;

// Walks over an array of the root, and adds the element's place to faults.
class GltfSections {
 public:
  GltfSections(const GltfFile& file, const GltfJson& root) : file_(file), root_(root) {}

  std::size_t size(const char* key) const {
    const auto found = root_.find(key);
    return found != root_.end() && found->is_array() ? found->size() : 0;
  }

  template <class Visit>
  void each(const char* key, std::size_t most, Visit&& visit) const {
    const auto found = root_.find(key);
    if (found == root_.end()) return;
    if (!found->is_array())
      throw Error::at_byte(file_.name, file_.json.begin, fmt::format("{} is not an array", key));
    if (found->size() > most) {
      throw Error::at_byte(file_.name, file_.json.begin,
                           fmt::format("{} {}: more than {}", found->size(), key, most));
    }
    std::size_t index = 0;
    for (const GltfJson& element : *found) {
      try {
        visit(element);
      } catch (const GltfFault& fault) {
        throw gltf_error(file_, key, index, fault.message);
      }
      ++index;
    }
  }

 private:
  const GltfFile& file_;
  const GltfJson& root_;
};

GltfBuffer buffer_of(const GltfJson& json, bool is_first, const GltfFile& file) {
  GltfBuffer buffer;
  buffer.size = gltf_needed_whole(json, "byteLength");
  std::string uri = gltf_text(json, "uri");
  if (json.find("uri") == json.end()) {
    if (is_first && file.binary) buffer.place = GltfBuffer::Place::binary_chunk;
  } else if (is_data_uri(uri)) {
    buffer.place = GltfBuffer::Place::in_text;
  } else {
    buffer.place = GltfBuffer::Place::beside;
    buffer.path = relative_path_of_uri(uri).value_or("");
    buffer.uri = std::move(uri);
  }
  return buffer;
}

GltfView view_of(const GltfJson& json) {
  GltfView view;
  view.buffer = gltf_needed_whole(json, "buffer");
  view.offset = gltf_whole(json, "byteOffset", 0);
  view.size = gltf_needed_whole(json, "byteLength");
  view.stride = gltf_whole(json, "byteStride", 0);
  const GltfJson* const extensions = gltf_field(json, "extensions");
  if (extensions == nullptr || !extensions->is_object()) return view;
  for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (extensions->contains(name)) view.coded = name;
  }
  return view;
}

std::size_t width_of_type(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> widths{{{"SCALAR", 1},
                                                                            {"VEC2", 2},
                                                                            {"VEC3", 3},
                                                                            {"VEC4", 4},
                                                                            {"MAT2", 4},
                                                                            {"MAT3", 9},
                                                                            {"MAT4", 16}}};
  for (const auto& [name, width] : widths) {
    if (type == name) return width;
  }
  return 0;
}

GltfSparse sparse_of(const GltfJson& json) {
  GltfSparse sparse;
  sparse.count = gltf_needed_whole(json, "count");
  const GltfJson* const indices = gltf_field(json, "indices");
  const GltfJson* const values = gltf_field(json, "values");
  if (indices == nullptr || values == nullptr) throw GltfFault{"sparse lacks indices or values"};
  sparse.index_view = gltf_needed_whole(*indices, "bufferView");
  sparse.index_offset = gltf_whole(*indices, "byteOffset", 0);
  sparse.index_component = static_cast<int>(gltf_needed_whole(*indices, "componentType") & 0xFFFF);
  sparse.value_view = gltf_needed_whole(*values, "bufferView");
  sparse.value_offset = gltf_whole(*values, "byteOffset", 0);
  return sparse;
}

GltfAccessor accessor_of(const GltfJson& json) {
  GltfAccessor accessor;
  accessor.view = gltf_whole(json, "bufferView");
  accessor.offset = gltf_whole(json, "byteOffset", 0);
  accessor.count = gltf_needed_whole(json, "count");
  accessor.component = static_cast<int>(gltf_needed_whole(json, "componentType") & 0xFFFF);
  accessor.width = width_of_type(gltf_text(json, "type"));
  accessor.normalized = gltf_flag(json, "normalized");
  accessor.has_range = json.contains("min") || json.contains("max");
  if (const GltfJson* const sparse = gltf_field(json, "sparse"))
    accessor.sparse = sparse_of(*sparse);
  return accessor;
}

// Rejects numbers that are so large that their products overflow.
void check_node_range(const GltfNode& node) {
  // Chosen by hand, as in `read_sample`.
  constexpr double most = 1e100;
  for (const Vec3 v : {node.translation, node.scale}) {
    if (!(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}) <= most))
      throw GltfFault{"a translation or scale is beyond 1e100"};
  }
}

GltfNode node_of(const GltfJson& json, std::size_t nodes) {
  GltfNode node;
  node.name = gltf_text(json, "name");
  for (const std::size_t child : gltf_indices(json, "children", nodes))
    node.children.push_back(static_cast<std::uint32_t>(child));
  for (const char* const key : {"mesh", "camera"}) node.holds_more |= json.contains(key);
  if (const auto matrix = gltf_numbers(json, "matrix", 16)) {
    const GltfPlacement placement = placement_of_matrix(*matrix);
    node.translation = placement.translation;
    node.rotation = placement.rotation;
    node.scale = placement.scale;
    node.has_matrix = true;
    node.is_sheared = placement.is_sheared;
  }
  if (const auto t = gltf_numbers(json, "translation", 3))
    node.translation = {(*t)[0], (*t)[1], (*t)[2]};
  if (const auto s = gltf_numbers(json, "scale", 3)) node.scale = {(*s)[0], (*s)[1], (*s)[2]};
  if (const auto q = gltf_numbers(json, "rotation", 4))
    node.rotation = unit_rotation({(*q)[3], (*q)[0], (*q)[1], (*q)[2]});
  check_node_range(node);
  return node;
}

GltfPath path_of(const std::string& path) {
  if (path == "translation") return GltfPath::translation;
  if (path == "rotation") return GltfPath::rotation;
  return path == "scale" ? GltfPath::scale : GltfPath::other;
}

GltfInterpolation interpolation_of(const GltfJson& sampler) {
  const std::string name = gltf_text(sampler, "interpolation");
  if (name == "STEP") return GltfInterpolation::step;
  if (name == "CUBICSPLINE") return GltfInterpolation::cubic_spline;
  if (name.empty() || name == "LINEAR") return GltfInterpolation::linear;
  throw GltfFault{"a sampler interpolates by neither STEP, LINEAR nor CUBICSPLINE"};
}

const GltfJson& gltf_array(const GltfJson& json, const char* key) {
  static const GltfJson none = GltfJson::array();
  const GltfJson* const array = gltf_field(json, key);
  if (array == nullptr) return none;
  if (!array->is_array()) throw GltfFault{fmt::format("{} is not an array", key)};
  if (array->size() > most_gltf_elements)
    throw GltfFault{fmt::format("{} {}: more than {}", array->size(), key, most_gltf_elements)};
  return *array;
}

GltfChannel channel_of(const GltfJson& json, std::size_t samplers, std::size_t nodes) {
  GltfChannel channel;
  channel.sampler = gltf_needed_whole(json, "sampler");
  if (channel.sampler >= samplers) throw GltfFault{"a channel names a sampler that is not there"};
  const GltfJson* const target = gltf_field(json, "target");
  if (target == nullptr) throw GltfFault{"a channel has no target"};
  channel.path = path_of(gltf_text(*target, "path"));
  if (const auto node = gltf_whole(*target, "node")) {
    if (*node >= nodes) throw GltfFault{"a channel names a node that is not there"};
    channel.node = static_cast<std::int64_t>(*node);
  }
  return channel;
}

GltfAnimation animation_of(const GltfJson& json, const GltfModel& model) {
  GltfAnimation animation;
  animation.name = gltf_text(json, "name");
  for (const GltfJson& entry : gltf_array(json, "samplers")) {
    GltfSampler sampler{gltf_needed_whole(entry, "input"), gltf_needed_whole(entry, "output"),
                        interpolation_of(entry)};
    if (std::max(sampler.input, sampler.output) >= model.accessors.size())
      throw GltfFault{"a sampler names an accessor that is not there"};
    animation.samplers.push_back(sampler);
  }
  for (const GltfJson& entry : gltf_array(json, "channels"))
    animation.channels.push_back(channel_of(entry, animation.samplers.size(), model.nodes.size()));
  return animation;
}

// Collects the indices of all accessors that a mesh names. Faults in meshes are ignored, because
// they do not affect motion.
void add_mesh_accessors(const GltfJson& json, std::vector<std::size_t>& used) {
  const auto add = [&](const GltfJson& attributes) {
    if (!attributes.is_object()) return;
    for (const GltfJson& value : attributes) {
      if (value.is_number_unsigned()) used.push_back(value.get<std::size_t>());
    }
  };
  if (!json.is_object() || !json.contains("primitives")) return;
  for (const GltfJson& primitive : json["primitives"]) {
    if (!primitive.is_object()) continue;
    if (primitive.contains("attributes")) add(primitive["attributes"]);
    if (primitive.contains("indices")) add({{"indices", primitive["indices"]}});
    if (!primitive.contains("targets")) continue;
    for (const GltfJson& target : primitive["targets"]) add(target);
  }
}

void add_image(const GltfJson& json, GltfModel& model) {
  if (const auto view = gltf_whole(json, "bufferView")) model.image_views.push_back(*view);
  const GltfJson* const uri = gltf_field(json, "uri");
  if (uri == nullptr || !uri->is_string()) return;
  const auto& text = uri->get_ref<const std::string&>();
  if (is_data_uri(text)) return;
  if (auto path = relative_path_of_uri(text)) model.image_paths.push_back(std::move(*path));
}

void link_parents(const GltfFile& file, GltfModel& model) {
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    for (const std::uint32_t child : model.nodes[n].children) {
      if (model.nodes[child].parent >= 0)
        throw gltf_error(file, "nodes", child, "a node with two parents");
      model.nodes[child].parent = static_cast<std::int64_t>(n);
    }
  }
}

void refuse_cycles(const GltfFile& file, const GltfModel& model) {
  std::vector<std::size_t> open = model.roots;
  std::vector<std::uint8_t> seen(model.nodes.size());
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    seen[node] = 1;
    open.insert(open.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
  }
  const auto lost = std::find(seen.begin(), seen.end(), 0);
  if (lost == seen.end()) return;
  throw gltf_error(file, "nodes", static_cast<std::size_t>(lost - seen.begin()),
                   "a node that is its own ancestor");
}

void find_roots(const GltfFile& file, const GltfSections& sections, const GltfJson& root,
                GltfModel& model) {
  std::vector<std::uint8_t> taken(model.nodes.size());
  const auto take = [&](std::size_t node) {
    if (model.nodes[node].parent >= 0 || taken[node] != 0) return;
    taken[node] = 1;
    model.roots.push_back(node);
  };
  std::size_t index = 0, shown = 0;
  const auto scene = root.find("scene");
  if (scene != root.end() && scene->is_number_unsigned()) shown = scene->get<std::size_t>();
  sections.each("scenes", most_gltf_elements, [&](const GltfJson& json) {
    const auto nodes = gltf_indices(json, "nodes", model.nodes.size());
    if (index++ == shown) std::for_each(nodes.begin(), nodes.end(), take);
  });
  for (std::size_t node = 0; node < model.nodes.size(); ++node) take(node);
  refuse_cycles(file, model);
}

void read_sections(const GltfFile& file, const GltfJson& root, GltfModel& model) {
  const GltfSections sections(file, root);
  const std::size_t nodes = sections.size("nodes"), most = most_gltf_elements;
  sections.each("buffers", most, [&](const GltfJson& json) {
    model.buffers.push_back(buffer_of(json, model.buffers.empty(), file));
  });
  sections.each("bufferViews", most,
                [&](const GltfJson& json) { model.views.push_back(view_of(json)); });
  sections.each("accessors", most,
                [&](const GltfJson& json) { model.accessors.push_back(accessor_of(json)); });
  sections.each("nodes", most_gltf_nodes,
                [&](const GltfJson& json) { model.nodes.push_back(node_of(json, nodes)); });
  sections.each("skins", most, [&](const GltfJson& json) {
    model.skins.push_back(gltf_indices(json, "joints", nodes));
    if (const auto matrices = gltf_whole(json, "inverseBindMatrices"))
      model.used_elsewhere.push_back(*matrices);
  });
  sections.each("animations", most, [&](const GltfJson& json) {
    model.animations.push_back(animation_of(json, model));
  });
  sections.each("meshes", most, [&](const GltfJson& json) {
    ++model.meshes;
    add_mesh_accessors(json, model.used_elsewhere);
  });
  sections.each("images", most, [&](const GltfJson& json) { add_image(json, model); });
  link_parents(file, model);
  find_roots(file, sections, root, model);
}

GltfJson parsed_root(const GltfFile& file) {
  GltfJson root = parse_json<GltfJson>(without_inline_data(file.json_text()), false);
  if (root.is_object()) return root;
  // Parses the original text again, for the place of the fault.
  try {
    root = parse_json<GltfJson>(file.json_text());
  } catch (const GltfJson::exception& error) {
    const auto* const place = dynamic_cast<const GltfJson::parse_error*>(&error);
    const std::size_t at = place == nullptr || place->byte == 0 ? 0 : place->byte - 1;
    throw Error::at_byte(file.name, file.json.begin + at,
                         "not JSON, or nested too deeply: expected the text of a glTF scene");
  }
  throw Error::at_byte(file.name, file.json.begin, "the JSON is no object");
}

void read_asset(const GltfFile& file, const GltfJson& root, GltfModel& model) {
  const auto asset = root.find("asset");
  const bool has_version = asset != root.end() && asset->is_object() && asset->contains("version");
  if (!has_version) throw Error::at_byte(file.name, file.json.begin, "not glTF: no asset.version");
  const GltfJson& version = (*asset)["version"];
  const std::string text = version.is_string() ? version.get<std::string>() : version.dump();
  if (!text.starts_with("2")) {
    throw Error::at_byte(file.name, file.json.begin,
                         fmt::format("glTF of version {}: only 2 is read", text));
  }
  const auto generator = asset->find("generator");
  if (generator != asset->end() && generator->is_string())
    model.generator = generator->get<std::string>();
}

}  // namespace

GltfModel parse_gltf(const GltfFile& file) {
  const GltfJson root = parsed_root(file);
  GltfModel model;
  read_asset(file, root, model);
  read_sections(file, root, model);
  return model;
}

std::string name_of_node(const GltfModel& model, std::size_t node) {
  const std::string& name = model.nodes[node].name;
  return name.empty() ? fmt::format("node_{}", node) : name;
}

std::string name_of_animation(const GltfModel& model, std::size_t animation) {
  const std::string& name = model.animations[animation].name;
  return name.empty() ? fmt::format("#{}", animation + 1) : name;
}

namespace {

// Returns the rotation of three orthonormal columns by Shepperd's method, which starts from the
// largest of the four parts.
Quat rotation_of_axes(const std::array<Vec3, 3>& c) {
  const double xx = c[0].x, yy = c[1].y, zz = c[2].z;
  const std::array<double, 4> parts{xx + yy + zz, xx, yy, zz};
  const auto largest = std::max_element(parts.begin(), parts.end()) - parts.begin();
  const double xy = c[0].y + c[1].x, yz = c[1].z + c[2].y, zx = c[2].x + c[0].z;
  const Vec3 odd{c[1].z - c[2].y, c[2].x - c[0].z, c[0].y - c[1].x};
  switch (largest) {
    case 0:
      return normalized({1 + parts[0], odd.x, odd.y, odd.z});
    case 1:
      return normalized({odd.x, 1 + xx - yy - zz, xy, zx});
    case 2:
      return normalized({odd.y, xy, 1 + yy - xx - zz, yz});
    default:
      return normalized({odd.z, zx, yz, 1 + zz - xx - yy});
  }
}

// Orthonormalises by Gram-Schmidt; an axis of length 0 gets a substitute direction.
std::array<Vec3, 3> orthonormal(const std::array<Vec3, 3>& columns) {
  const auto unit = [](Vec3 v, Vec3 otherwise) {
    const double length = norm(v);
    return length > 0 && std::isfinite(length) ? (1 / length) * v : otherwise;
  };
  const Vec3 x = unit(columns[0], {1, 0, 0});
  const Vec3 aside = std::fabs(x.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 y = unit(columns[1] - dot(x, columns[1]) * x, unit(cross(x, aside), {0, 1, 0}));
  return {x, y, cross(x, y)};
}

}  // namespace

Quat unit_rotation_of_any(Quat q) {
  const double largest = std::max({std::fabs(q.w), std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  return normalized((1 / largest) * q);
}

GltfPlacement placement_of_matrix(std::span<const double> m) {
  // Chosen by hand, not swept.
  constexpr double least_shear = 1e-4;  // share of the lengths of the axes
  const std::array<Vec3, 3> columns{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}};
  const bool mirrors = dot(cross(columns[0], columns[1]), columns[2]) < 0;
  const double sign = mirrors ? -1 : 1;
  const std::array<Vec3, 3> turned{{sign * columns[0], sign * columns[1], sign * columns[2]}};
  const std::array<Vec3, 3> axes = orthonormal(turned);
  GltfPlacement placement;
  placement.translation = {m[12], m[13], m[14]};
  placement.rotation = rotation_of_axes(axes);
  placement.scale = sign * Vec3{norm(columns[0]), norm(columns[1]), norm(columns[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = norm(columns[i]);
    placement.is_sheared |= norm(turned[i] - length * axes[i]) > least_shear * length;
  }
  return placement;
}

}  // namespace kinemend
