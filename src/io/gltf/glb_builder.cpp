// Lays out the JSON and the binary data of a glTF file.
#include "io/gltf/glb_builder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "kinemend/error.hpp"
#include "kinemend/experimental/version.hpp"

namespace kinemend {

namespace {

constexpr int component_float = 5126, component_uint16 = 5123;
constexpr int target_array_buffer = 34962;
constexpr std::uint32_t magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

// A number that is finite as a double may overflow as a float.
void check_finite(std::span<const float> values) {
  if (std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    return;
  throw Error(ErrorKind::usage, "a length is too large for a glTF file");
}

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
}

void pad(std::string& bytes, char filler) {
  while (bytes.size() % 4 != 0) bytes += filler;
}

const char* type_of(std::size_t components) {
  switch (components) {
    case 1:
      return "SCALAR";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "MAT4";
  }
}

}  // namespace

GlbBuilder::GlbBuilder() {
  static_assert(std::endian::native == std::endian::little, "glTF holds little-endian numbers");
  document_["asset"] = {{"version", "2.0"}, {"generator", "Kinemend " + std::string(version())}};
  document_["scene"] = 0;
  document_["scenes"] = Json::array({{{"nodes", Json::array()}}});
  document_["nodes"] = Json::array();
}

std::size_t GlbBuilder::add_node(Json node) {
  document_["nodes"].push_back(std::move(node));
  return document_["nodes"].size() - 1;
}

std::size_t GlbBuilder::add_view(const void* data, std::size_t bytes, bool of_vertices) {
  pad(binary_, '\0');
  Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}};
  if (of_vertices) view["target"] = target_array_buffer;
  binary_.append(static_cast<const char*>(data), bytes);
  document_["bufferViews"].push_back(std::move(view));
  return document_["bufferViews"].size() - 1;
}

std::size_t GlbBuilder::add_accessor(std::size_t view, int component_type, std::size_t count,
                                     const char* type) {
  document_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return document_["accessors"].size() - 1;
}

std::size_t GlbBuilder::add_floats(const std::vector<float>& values, std::size_t components,
                                   bool with_range, bool of_vertices) {
  check_finite(values);
  const std::size_t view = add_view(values.data(), values.size() * sizeof(float), of_vertices);
  const std::size_t index =
      add_accessor(view, component_float, values.size() / components, type_of(components));
  if (with_range) {
    std::vector<float> least(values.begin(),
                             values.begin() + static_cast<std::ptrdiff_t>(components));
    std::vector<float> most = least;
    for (std::size_t i = 0; i < values.size(); ++i) {
      least[i % components] = std::min(least[i % components], values[i]);
      most[i % components] = std::max(most[i % components], values[i]);
    }
    document_["accessors"][index]["min"] = least;
    document_["accessors"][index]["max"] = most;
  }
  return index;
}

std::size_t GlbBuilder::add_vertex_joints(const std::vector<std::uint16_t>& values) {
  const std::size_t view = add_view(values.data(), values.size() * sizeof(std::uint16_t), true);
  return add_accessor(view, component_uint16, values.size() / 4, "VEC4");
}

std::string GlbBuilder::finish() && {
  pad(binary_, '\0');
  if (!binary_.empty()) document_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  std::string json = document_.dump(-1, ' ', false, Json::error_handler_t::ignore);
  pad(json, ' ');
  const std::size_t total = 12 + 8 + json.size() + (binary_.empty() ? 0 : 8 + binary_.size());
  if (total > 0xFFFFFFFFu) {
    throw Error(ErrorKind::usage, "the clip is too long for a glb file of 4 GiB");
  }
  std::string file;
  file.reserve(total);
  append_u32(file, magic);
  append_u32(file, 2);
  append_u32(file, static_cast<std::uint32_t>(total));
  append_u32(file, static_cast<std::uint32_t>(json.size()));
  append_u32(file, chunk_json);
  file += json;
  if (binary_.empty()) return file;
  append_u32(file, static_cast<std::uint32_t>(binary_.size()));
  append_u32(file, chunk_binary);
  return file + binary_;
}

GlbAnimation::GlbAnimation(GlbBuilder& file, std::size_t frames, double frame_rate_hz)
    : file_(file) {
  std::vector<float> times(frames);
  for (std::size_t f = 0; f < frames; ++f)
    times[f] = static_cast<float>(static_cast<double>(f) / frame_rate_hz);
  times_ = file_.add_floats(times, 1, true, false);
}

void GlbAnimation::add_channel(std::size_t node, const char* path, std::size_t output,
                               const char* interpolation) {
  samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", interpolation}});
  channels_.push_back(
      {{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

void GlbAnimation::add_translation(std::size_t node, const std::vector<float>& xyz) {
  add_channel(node, "translation", file_.add_floats(xyz, 3, false, false), "LINEAR");
}

void GlbAnimation::add_rotation(std::size_t node, std::vector<Quat> rotations) {
  align_hemispheres(rotations);
  std::vector<float> xyzw;
  xyzw.reserve(4 * rotations.size());
  for (const Quat& q : rotations) {
    for (const double value : {q.x, q.y, q.z, q.w}) xyzw.push_back(static_cast<float>(value));
  }
  add_channel(node, "rotation", file_.add_floats(xyzw, 4, false, false), "LINEAR");
}

void GlbAnimation::add_presence(std::size_t node, const std::vector<std::uint8_t>& present) {
  std::vector<float> scales;
  for (const std::uint8_t there : present) scales.insert(scales.end(), 3, there != 0 ? 1.0F : 0.0F);
  add_channel(node, "scale", file_.add_floats(scales, 3, false, false), "STEP");
}

void GlbAnimation::finish() {
  if (channels_.empty()) return;
  file_.document()["animations"] = Json::array(
      {{{"name", "take"}, {"samplers", std::move(samplers_)}, {"channels", std::move(channels_)}}});
}

void GlbMesh::add_triangle(const std::array<Vec3, 3>& corners, Vec3 inside, std::uint16_t joint) {
  std::array<Vec3, 3> c = corners;
  Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
  if (dot(normal, c[0] - inside) < 0) {
    std::swap(c[1], c[2]);
    normal = -normal;
  }
  const double length = norm(normal);
  if (!(length > 0)) return;
  const auto direction = to_floats((1 / length) * normal);
  for (const Vec3& corner : c) {
    const auto place = to_floats(corner);
    positions.insert(positions.end(), place.begin(), place.end());
    normals.insert(normals.end(), direction.begin(), direction.end());
    joints.push_back(joint);
  }
}

std::array<float, 3> to_floats(Vec3 v) {
  const std::array<float, 3> floats{static_cast<float>(v.x), static_cast<float>(v.y),
                                    static_cast<float>(v.z)};
  check_finite(floats);
  return floats;
}

std::size_t add_mesh(GlbBuilder& file, const GlbMesh& mesh, const char* name) {
  file.document()["materials"] = Json::array({{{"name", name},
                                               {"pbrMetallicRoughness",
                                                {{"baseColorFactor", {0.85, 0.55, 0.2, 1}},
                                                 {"metallicFactor", 0},
                                                 {"roughnessFactor", 0.7}}}}});
  Json attributes{{"POSITION", file.add_floats(mesh.positions, 3, true, true)},
                  {"NORMAL", file.add_floats(mesh.normals, 3, false, true)}};
  if (!mesh.joints.empty()) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (const std::uint16_t joint : mesh.joints) {
      joints.insert(joints.end(), {joint, 0, 0, 0});
      weights.insert(weights.end(), {1, 0, 0, 0});
    }
    attributes["JOINTS_0"] = file.add_vertex_joints(joints);
    attributes["WEIGHTS_0"] = file.add_floats(weights, 4, false, true);
  }
  file.document()["meshes"].push_back(
      {{"name", name},
       {"primitives", Json::array({{{"attributes", attributes}, {"material", 0}}})}});
  return file.document()["meshes"].size() - 1;
}

}  // namespace kinemend
