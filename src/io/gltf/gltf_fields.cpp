// Checks the type and the range of JSON values.
#include "io/gltf/gltf_fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinemend {

namespace {

// Reads a whole number, which some writers write as 5126.0.
std::optional<std::size_t> gltf_whole_value(const GltfJson& value) {
  constexpr double most = 9007199254740992.0;  // 2^53: whole numbers up to it are exact
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_float()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(number >= 0 && number <= most) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::size_t>(number);
}

}  // namespace

const GltfJson* gltf_field(const GltfJson& object, const char* key) {
  if (!object.is_object()) throw GltfFault{"expected an object"};
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::size_t> gltf_whole(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return std::nullopt;
  const auto whole = gltf_whole_value(*value);
  if (!whole) throw GltfFault{fmt::format("{} is not a whole number", key)};
  return whole;
}

std::size_t gltf_whole(const GltfJson& object, const char* key, std::size_t otherwise) {
  return gltf_whole(object, key).value_or(otherwise);
}

std::size_t gltf_needed_whole(const GltfJson& object, const char* key) {
  const auto value = gltf_whole(object, key);
  if (!value) throw GltfFault{fmt::format("{} is missing", key)};
  return *value;
}

std::string gltf_text(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return {};
  if (!value->is_string()) throw GltfFault{fmt::format("{} is not a text", key)};
  return value->get<std::string>();
}

bool gltf_flag(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) throw GltfFault{fmt::format("{} is neither true nor false", key)};
  return value->get<bool>();
}

std::optional<std::vector<double>> gltf_numbers(const GltfJson& object, const char* key,
                                                std::size_t count) {
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return std::nullopt;
  std::vector<double> numbers;
  if (value->is_array() && value->size() == count) {
    for (const GltfJson& element : *value) {
      if (element.is_number()) numbers.push_back(element.get<double>());
    }
  }
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (numbers.size() != count || !std::all_of(numbers.begin(), numbers.end(), is_finite))
    throw GltfFault{fmt::format("{} is not an array of {} numbers", key, count)};
  return numbers;
}

std::vector<std::size_t> gltf_indices(const GltfJson& object, const char* key, std::size_t limit) {
  std::vector<std::size_t> indices;
  const GltfJson* const value = gltf_field(object, key);
  if (value == nullptr) return indices;
  if (!value->is_array()) throw GltfFault{fmt::format("{} is not an array", key)};
  indices.reserve(value->size());
  for (const GltfJson& element : *value) {
    const auto index = gltf_whole_value(element);
    if (!index) throw GltfFault{fmt::format("{} holds what is no whole number", key)};
    if (*index >= limit)
      throw GltfFault{fmt::format("{} names {}, of {} that there are", key, *index, limit)};
    indices.push_back(*index);
  }
  return indices;
}

}  // namespace kinemend
