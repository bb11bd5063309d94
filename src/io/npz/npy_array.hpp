// Reads and writes arrays of NumPy as the members of an npz file hold them: a head in text, then
// the elements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/error.hpp"

namespace kinemend {

/// The origin of an array, for messages.
struct NpyPlace {
  std::string file;
  std::string array;
  std::size_t begin = 0;  ///< byte of its member

  Error error(std::string_view message) const;
};

/// An array of numbers or texts, with any order of elements and bytes.
struct NpyArray {
  NpyPlace place;
  std::string content;       ///< the whole member
  std::size_t elements = 0;  ///< offset of the elements in `content`
  char kind = 'f';           ///< f, i, u, b (numbers), U, S (texts)
  std::size_t item_bytes = 0;
  bool is_big_endian = false;
  bool is_fortran = false;  ///< the first index varies fastest
  std::vector<std::size_t> shape;

  std::size_t count() const;
  bool holds_numbers() const { return kind != 'U' && kind != 'S'; }
};

/// Reads the head of an array. Errors: `unreadable_input` with the byte of the member if it is not
/// an array, its elements are of another kind, or are fewer than the shape says.
NpyArray read_npy(std::string content, NpyPlace place);

/// Reads the elements of an array of numbers from `first` on, counted in C order, into `values`.
/// Numbers that are not finite become NaN, and so do numbers beyond 1e100, whose squares may
/// overflow.
void npy_numbers(const NpyArray& array, std::size_t first, std::span<double> values);
/// Returns one of these numbers.
double npy_number(const NpyArray& array, std::size_t index);
/// Returns the text of one element in UTF-8. A character that Python's `surrogateescape` made from
/// a byte becomes that byte again. Errors: `unreadable_input` for a code that is not a character.
std::string npy_text(const NpyArray& array, std::size_t index);

/// Return members to write, with little-endian elements in C order.
std::string npy_of(std::span<const double> values, std::span<const std::size_t> shape);
std::string npy_of(std::span<const std::int32_t> values, std::span<const std::size_t> shape);
std::string npy_of(std::span<const std::uint8_t> values, std::span<const std::size_t> shape);
/// Returns an array of texts with one dimension, or with none (a single text) if `is_scalar`. Bytes
/// that are not UTF-8 are encoded as by Python's `surrogateescape`. Errors: `usage` for texts that
/// would need 64 MiB.
std::string npy_of(std::span<const std::string> texts, bool is_scalar = false);

}  // namespace kinemend
