// Reads fields of JSON objects with checks of their type.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "kinemend/rotation.hpp"

namespace kinemend {

/// An error in a field; it becomes an `Error` with a place once the element is known.
struct GltfFault {
  std::string message;
};

// Each function throws `GltfFault` for a value of another type, and for a missing value without
// default.
using GltfJson = nlohmann::json;

const GltfJson* gltf_field(const GltfJson& object, const char* key);
std::optional<std::size_t> gltf_whole(const GltfJson& object, const char* key);
std::size_t gltf_whole(const GltfJson& object, const char* key, std::size_t otherwise);
std::size_t gltf_needed_whole(const GltfJson& object, const char* key);
std::string gltf_text(const GltfJson& object, const char* key);
bool gltf_flag(const GltfJson& object, const char* key);
/// Returns an array of exactly `count` finite numbers; empty if the field is missing.
std::optional<std::vector<double>> gltf_numbers(const GltfJson& object, const char* key,
                                                std::size_t count);
/// Returns an array of indices below `limit`.
std::vector<std::size_t> gltf_indices(const GltfJson& object, const char* key, std::size_t limit);

}  // namespace kinemend
