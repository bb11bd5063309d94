// Files of named arrays of numbers (safetensors), in which learned models are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// How the numbers of a tensor are stored. In memory they are doubles.
enum class TensorType : std::uint8_t { f64, f32, f16, i32, i8, u8 };

struct Tensor {
  TensorType stored = TensorType::f32;
  std::vector<std::size_t> shape;  ///< empty: one number
  std::vector<double> values;      ///< row-major; their number is the product of the shape

  std::size_t size() const noexcept { return values.size(); }
};

/// The contents of a safetensors file.
struct TensorFile {
  std::map<std::string, std::string, std::less<>> metadata;
  std::map<std::string, Tensor, std::less<>> tensors;
};

/// Reads a safetensors file; `name` is for messages. Numbers are finite. Errors:
/// `ErrorKind::unreadable_input`, `<name>: byte N: expected ..., found ...`, for a header that is
/// not a valid JSON object, a type that is not in `TensorType`, spans that overlap, leave holes or
/// do not match their shapes or the file's length, and numbers that are not finite. No memory is
/// allocated for a size that the file's length does not confirm.
TensorFile parse_tensors(std::string_view bytes, std::string_view name);

/// Returns the bytes of a safetensors file: entries in the order of their names, data aligned to 8
/// bytes; the same contents give the same bytes. Values are rounded to their stored type. Errors:
/// `ErrorKind::usage` for a tensor whose values do not match its shape or do not fit its type.
std::string write_tensors(const TensorFile& file);

}  // namespace kinemend
