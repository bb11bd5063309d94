// The header of a safetensors file: JSON with the position of each tensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/tensor.hpp"

namespace kinemend {

// The most dimensions of a tensor, chosen by hand.
inline constexpr std::string_view metadata_key = "__metadata__";
inline constexpr std::size_t most_dimensions = 32;

/// "F32"
std::string_view safetensors_name(TensorType type);
std::size_t bytes_per_value(TensorType type);

struct TensorEntry {
  std::string name;
  TensorType type = TensorType::f32;
  std::vector<std::size_t> shape;
  std::size_t count = 0;  ///< number of values
  std::size_t begin = 0;  ///< of its bytes, from the start of the data
  std::size_t end = 0;
};

struct TensorHeader {
  std::map<std::string, std::string, std::less<>> metadata;
  std::vector<TensorEntry> entries;  ///< in the order of their bytes, which fill the data
  std::size_t data_begin = 0;        ///< in the file
};

/// Reads the header and checks it against the length of the file. Errors: those of `parse_tensors`.
TensorHeader parse_tensor_header(std::string_view bytes, std::string_view name);

}  // namespace kinemend
