// Reads the elements of NumPy's arrays, and writes arrays (NEP 1, "A simple file format for NumPy
// arrays").
#include "io/npz/npy_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/bits.hpp"
#include "base/quote.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

static_assert(std::endian::native == std::endian::little, "elements are written as they are");

constexpr std::string_view npy_mark = "\x93NUMPY";
// Python's surrogateescape: byte 0x80 is U+DC80.
constexpr std::uint32_t escaped_bytes = 0xDC00;

Error npy_error(const NpyPlace& place, std::string_view message) {
  return Error::at_byte(place.file, place.begin,
                        fmt::format("array {}: {}", quote(place.array), message));
}

// Returns the place of element `index` (in C order) in an array in Fortran order, whose first index
// varies fastest.
std::size_t place_in_fortran_order(const std::vector<std::size_t>& shape, std::size_t index) {
  std::size_t place = 0, stride = 1;
  for (const std::size_t extent : shape) stride *= extent;
  for (std::size_t i = shape.size(); i-- > 0;) {
    stride /= shape[i];
    place += index % shape[i] * stride;
    index /= shape[i];
  }
  return place;
}

std::uint64_t bits_of_element(const NpyArray& array, std::size_t index) {
  const std::size_t stored = array.is_fortran ? place_in_fortran_order(array.shape, index) : index;
  const char* const element = array.content.data() + array.elements + stored * array.item_bytes;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < array.item_bytes; ++i) {
    const std::size_t at = array.is_big_endian ? i : array.item_bytes - 1 - i;
    bits = bits << 8 | static_cast<unsigned char>(element[at]);
  }
  return bits;
}

// IEEE 754 binary16: 5 bits of exponent, 10 of fraction.
double number_of_half(std::uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 0x1F);
  const auto fraction = static_cast<double>(bits & 0x3FF);
  double value =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  if (exponent == 0x1F) value = std::numeric_limits<double>::quiet_NaN();
  return (bits >> 15 & 1) != 0 ? -value : value;
}

double number_of_bits(const NpyArray& array, std::uint64_t bits) {
  if (array.kind == 'f') {
    if (array.item_bytes == 8) return bits_as<double>(bits);
    if (array.item_bytes == 4)
      return static_cast<double>(bits_as<float>(static_cast<std::uint32_t>(bits)));
    return number_of_half(bits);
  }
  if (array.kind != 'i') return static_cast<double>(bits);
  const std::size_t unused = 64 - 8 * array.item_bytes;
  return static_cast<double>(bits_as<std::int64_t>(bits << unused) >> unused);
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

std::u32string codes_of(std::string_view text) {
  std::u32string codes;
  while (!text.empty()) {
    const Character character = first_character(text);
    codes += static_cast<char32_t>(
        character.is_valid ? character.code : escaped_bytes + static_cast<unsigned char>(text[0]));
    text.remove_prefix(character.size);
  }
  return codes;
}

template <class Value>
std::string npy_of_values(std::string_view type, std::span<const Value> values,
                          std::span<const std::size_t> shape) {
  std::string bytes = npy_head(type, shape);
  if (!values.empty())
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return bytes;
}

}  // namespace

std::size_t NpyArray::count() const {
  std::size_t product = 1;
  for (const std::size_t extent : shape) product *= extent;
  return product;
}

void npy_numbers(const NpyArray& array, std::size_t first, std::span<double> values) {
  constexpr double largest = 1e100;
  const bool is_plain =
      array.kind == 'f' && array.item_bytes == 8 && !array.is_big_endian && !array.is_fortran;
  if (is_plain && !values.empty()) {
    std::memcpy(values.data(), array.content.data() + array.elements + 8 * first,
                values.size_bytes());
  } else {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = number_of_bits(array, bits_of_element(array, first + i));
  }
  for (double& value : values) {
    if (!(std::fabs(value) <= largest)) value = std::numeric_limits<double>::quiet_NaN();
  }
}

std::string npy_text(const NpyArray& array, std::size_t index) {
  const std::size_t stored = array.is_fortran ? place_in_fortran_order(array.shape, index) : index;
  const std::string_view element(array.content.data() + array.elements + stored * array.item_bytes,
                                 array.item_bytes);
  std::string text;
  if (array.kind == 'S') {
    text = element;
  } else {
    for (std::size_t i = 0; i < element.size(); i += 4) {
      std::uint32_t code = 0;
      for (std::size_t b = 0; b < 4; ++b) {
        const std::size_t at = i + (array.is_big_endian ? b : 3 - b);
        code = code << 8 | static_cast<unsigned char>(element[at]);
      }
      const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
      const bool is_escaped = code >= escaped_bytes + 0x80 && code <= escaped_bytes + 0xFF;
      if (code > 0x10FFFF || (is_surrogate && !is_escaped))
        throw npy_error(array.place, fmt::format("text {} is damaged", index));
      if (is_escaped) {
        text += static_cast<char>(code - escaped_bytes);
      } else {
        append_utf8(text, code);
      }
    }
  }
  // Texts are padded to one size with zeros.
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

std::string npy_head(std::string_view type, std::span<const std::size_t> shape) {
  std::string extents;
  for (const std::size_t extent : shape) extents += fmt::format("{}, ", extent);
  if (shape.size() == 1) extents.pop_back();  // (3,)
  if (shape.size() > 1) extents.resize(extents.size() - 2);
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, extents);
  // Elements begin at a multiple of 64 bytes; a line end ends the head.
  constexpr std::size_t fixed = 10, alignment = 64;
  const std::size_t size = (fixed + text.size() + alignment) / alignment * alignment - fixed;
  text.resize(size - 1, ' ');
  text += '\n';
  std::string head(npy_mark);
  head += '\1';
  head += '\0';
  head += static_cast<char>(size & 0xFF);
  head += static_cast<char>(size >> 8);
  return head + text;
}

std::string npy_of(std::span<const double> values, std::span<const std::size_t> shape) {
  return npy_of_values("<f8", values, shape);
}

std::string npy_of(std::span<const std::int32_t> values, std::span<const std::size_t> shape) {
  return npy_of_values("<i4", values, shape);
}

std::string npy_of(std::span<const std::uint8_t> values, std::span<const std::size_t> shape) {
  return npy_of_values("|u1", values, shape);
}

std::string npy_of(std::span<const std::string> texts, bool is_scalar) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, codes_of(text).size());
  constexpr std::size_t most_bytes = std::size_t{64} << 20;
  if (width > most_bytes / 4 / std::max<std::size_t>(texts.size(), 1))
    throw Error(ErrorKind::usage, fmt::format("npz cannot hold names of {} characters", width));
  const std::size_t shape[] = {texts.size()};
  std::string bytes =
      npy_head(fmt::format("<U{}", width), std::span<const std::size_t>(shape, is_scalar ? 0 : 1));
  for (const std::string& text : texts) {
    std::u32string codes = codes_of(text);
    codes.resize(width);
    bytes.append(reinterpret_cast<const char*>(codes.data()), 4 * width);
  }
  return bytes;
}

}  // namespace kinemend
