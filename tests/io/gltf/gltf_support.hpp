#pragma once

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "io/support.hpp"

namespace kinemend::test {

inline std::filesystem::path scene_path(const std::string& name) {
  const std::string folder = name.ends_with(".glb") ? "glb" : "gltf";
  return std::filesystem::path(KINEMEND_TEST_FIXTURES) / folder / "good" / name;
}

inline std::filesystem::path scene_beside() {
  return std::filesystem::path(KINEMEND_TEST_FIXTURES) / "gltf/beside/walk cycle.gltf";
}

inline Take read_scene(const std::string& name, const ReadOptions& options = {}) {
  return read_joints(scene_path(name), options).take;
}

inline Take read_glb_bytes(std::string bytes) {
  return read_joints(std::move(bytes), "take.glb").take;
}

/// The parts of a binary file, read without the code of the reader.
struct SceneParts {
  nlohmann::json json;
  std::string binary;

  const nlohmann::json& accessor(std::size_t index) const { return json["accessors"][index]; }
  /// The first byte of an accessor's element, and the byte after its last.
  std::pair<std::size_t, std::size_t> element(std::size_t accessor_index, std::size_t i) const {
    const std::map<int, std::size_t> sizes{{5120, 1}, {5121, 1}, {5122, 2},
                                           {5123, 2}, {5125, 4}, {5126, 4}};
    const std::map<std::string, std::size_t> widths{
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const nlohmann::json& a = accessor(accessor_index);
    const nlohmann::json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t size = sizes.at(a["componentType"]) * widths.at(a["type"]);
    const std::size_t step = view.value("byteStride", size);
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0}) + i * step;
    return {begin, begin + size};
  }
  std::vector<float> floats(std::size_t accessor_index, std::size_t i) const {
    const auto [begin, end] = element(accessor_index, i);
    std::vector<float> values((end - begin) / sizeof(float));
    std::memcpy(values.data(), binary.data() + begin, end - begin);
    return values;
  }
  /// The output of a node's channel.
  std::size_t output(const std::string& node, const std::string& path,
                     std::size_t animation = 0) const {
    const nlohmann::json& chosen = json["animations"][animation];
    for (const auto& channel : chosen["channels"]) {
      const auto n = channel["target"]["node"].get<std::size_t>();
      if (json["nodes"][n].value("name", "") == node && channel["target"]["path"] == path)
        return chosen["samplers"][channel["sampler"].get<std::size_t>()]["output"];
    }
    ADD_FAILURE() << "no channel of " << node;
    return 0;
  }
};

inline SceneParts parts_of_glb(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  SceneParts parts;
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(number(8), bytes.size());
  EXPECT_EQ(bytes.size() % 4, 0u);
  parts.json = nlohmann::json::parse(bytes.substr(20, number(12)));
  const std::size_t chunk = 20 + number(12);
  parts.binary = bytes.substr(chunk + 8, number(chunk));
  return parts;
}

/// The elements that differ between two binaries of the same layout, as accessor and element. Bytes
/// outside all accessors are element 0 of accessor -1.
inline std::set<std::pair<int, std::size_t>> changed_elements(const SceneParts& a,
                                                              const SceneParts& b) {
  std::vector<std::pair<int, std::size_t>> owner(a.binary.size(), {-1, 0});
  for (std::size_t i = 0; i < a.json["accessors"].size(); ++i) {
    if (!a.accessor(i).contains("bufferView")) continue;
    for (std::size_t e = 0; e < a.accessor(i)["count"].get<std::size_t>(); ++e) {
      const auto [begin, end] = a.element(i, e);
      for (std::size_t at = begin; at < end; ++at) owner[at] = {static_cast<int>(i), e};
    }
  }
  std::set<std::pair<int, std::size_t>> changed;
  for (std::size_t at = 0; at < a.binary.size(); ++at) {
    if (at >= b.binary.size() || a.binary[at] != b.binary[at]) changed.insert(owner[at]);
  }
  return changed;
}

inline std::size_t joint_called(const Take& clip, const std::string& name) {
  const std::int32_t joint = clip.skeleton.find(name);
  EXPECT_GE(joint, 0) << name;
  return static_cast<std::size_t>(std::max(joint, 0));
}

inline void turn(Take& clip, std::size_t frame, const std::string& joint, Vec3 by) {
  Quat& q = clip.rotation(frame, joint_called(clip, joint));
  q = normalized(q * exp(by));
}

}  // namespace kinemend::test
