// Arrays of NumPy as the members of an npz file hold them: a head in text, then the elements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// Where an array comes from, for messages.
struct NpyPlace {
  std::string file;
  std::string array;
  std::size_t begin = 0;  ///< byte of its member
};

/// An array of numbers or texts, of any order of its elements and bytes.
struct NpyArray {
  NpyPlace place;
  std::string content;       ///< the whole member
  std::size_t elements = 0;  ///< where they begin in `content`
  char kind = 'f';           ///< f, i, u, b (numbers), U, S (texts)
  std::size_t item_bytes = 0;
  bool is_big_endian = false;
  bool is_fortran = false;  ///< the first index counts fastest
  std::vector<std::size_t> shape;

  std::size_t count() const;
  bool holds_numbers() const { return kind != 'U' && kind != 'S'; }
};

/// Errors: `unreadable_input` with the byte of the member: no array, elements of another kind, or
/// fewer than the shape says.
NpyArray read_npy(std::string content, NpyPlace place);

/// Elements `first` and on of an array of numbers, counted in C order, into `values`. Numbers
/// beyond 1e100, whose squares may not be finite, are NaN, as are those that are not finite.
void npy_numbers(const NpyArray& array, std::size_t first, std::span<double> values);
/// The text of one element, in UTF-8. A character that Python's `surrogateescape` makes of a byte
/// is that byte again. Errors: `unreadable_input` for a code that is no character.
std::string npy_text(const NpyArray& array, std::size_t index);

/// Members to write: the head, for elements in C order, lowest byte first.
std::string npy_head(std::string_view type, std::span<const std::size_t> shape);
std::string npy_of(std::span<const double> values, std::span<const std::size_t> shape);
std::string npy_of(std::span<const std::int32_t> values, std::span<const std::size_t> shape);
std::string npy_of(std::span<const std::uint8_t> values, std::span<const std::size_t> shape);
/// Of one index, or of none (a single text) when `is_scalar`. Bytes that are no UTF-8 become what
/// Python's `surrogateescape` makes of them. Errors: `usage` for texts that would need 64 MiB.
std::string npy_of(std::span<const std::string> texts, bool is_scalar = false);

}  // namespace kinemend
