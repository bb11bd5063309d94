// Parses the head of an array, a dictionary of Python as text, reads the elements, and writes
// arrays (NEP 1, "A simple file format for NumPy arrays").
#include "io/npz/npy_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/portable.hpp"
#include "base/text.hpp"

namespace kinemend {

namespace {

static_assert(std::endian::native == std::endian::little, "elements are written as they are");

constexpr std::string_view npy_mark = "\x93NUMPY";
// Python's surrogateescape: byte 0x80 is U+DC80.
constexpr std::uint32_t escaped_bytes = 0xDC00;

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

// Returns the head alone.
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

template <class Value>
std::string npy_of_values(std::string_view type, std::span<const Value> values,
                          std::span<const std::size_t> shape) {
  std::string bytes = npy_head(type, shape);
  if (!values.empty())
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return bytes;
}

}  // namespace

Error NpyPlace::error(std::string_view message) const {
  return Error::at_byte(file, begin, fmt::format("array {}: {}", quote(array), message));
}

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

double npy_number(const NpyArray& array, std::size_t index) {
  double value = 0;
  npy_numbers(array, index, {&value, 1});
  return value;
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
        throw array.place.error(fmt::format("text {} is damaged", index));
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

namespace {

constexpr std::size_t most_npy_dimensions = 32;  // the limit of NumPy

// Reads {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }, keys in any order.
class NpyHead {
 public:
  explicit NpyHead(std::string_view text) : text_(text) {}

  // Returns false for any other text.
  bool read(NpyArray& array) {
    if (!accept('{')) return false;
    while (!accept('}')) {
      const auto key = quoted();
      if (!key || !accept(':') || !read_value(*key, array)) return false;
      if (!accept(',') && !next_is('}')) return false;
    }
    return !type.empty() && has_order_ && has_shape_;
  }

  std::string type;  // "<f8"; "?" for a type with fields

 private:
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool next_is(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
  }
  bool accept(char c) {
    if (!next_is(c)) return false;
    ++at_;
    return true;
  }
  bool accept_word(std::string_view word) {
    skip_blanks();
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  std::optional<std::string> quoted() {
    skip_blanks();
    if (!next_is('\'') && !next_is('"')) return std::nullopt;
    const char mark = text_[at_];
    const std::size_t end = text_.find(mark, at_ + 1);
    if (end == text_.npos) return std::nullopt;
    std::string found(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return found;
  }

  bool read_value(const std::string& key, NpyArray& array) {
    if (key == "descr") return read_type();
    if (key == "fortran_order") {
      has_order_ = true;
      array.is_fortran = accept_word("True");
      return array.is_fortran || accept_word("False");
    }
    return key == "shape" && read_shape(array.shape);
  }

  bool read_type() {
    if (!next_is('[')) {
      type = quoted().value_or("");
      return !type.empty();
    }
    type = '?';
    for (int depth = 0; at_ < text_.size();) {
      const char c = text_[at_++];
      depth += c == '[' ? 1 : c == ']' ? -1 : 0;
      if (depth == 0) return true;
    }
    return false;
  }

  bool read_shape(std::vector<std::size_t>& shape) {
    shape.clear();
    has_shape_ = true;
    if (!accept('(')) return false;
    while (!accept(')')) {
      const auto extent = whole_number();
      if (!extent || shape.size() == most_npy_dimensions) return false;
      shape.push_back(*extent);
      if (!accept(',') && !next_is(')')) return false;
    }
    return true;
  }

  std::optional<std::size_t> whole_number() {
    constexpr std::size_t most_digits = 15;
    skip_blanks();
    const std::size_t begin = at_;
    std::size_t value = 0;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9')
      value = 10 * value + static_cast<std::size_t>(text_[at_++] - '0');
    if (at_ == begin || at_ - begin > most_digits) return std::nullopt;
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool has_order_ = false, has_shape_ = false;
};

class NpyReader {
 public:
  NpyReader(std::string content, NpyPlace place) {
    array_.content = std::move(content);
    array_.place = std::move(place);
  }

  NpyArray read() {
    NpyHead head(head_text());
    if (!head.read(array_)) throw array_.place.error("the head of the array is damaged");
    set_type(head.type);
    check_size();
    return std::move(array_);
  }

 private:
  // Versions 2 and 3 state the size of the head in four bytes instead of two.
  std::string_view head_text() {
    const std::string_view bytes = array_.content;
    constexpr std::size_t size_at = 8;
    if (bytes.substr(0, 6) != "\x93NUMPY" || bytes.size() < size_at)
      throw array_.place.error("is no array of NumPy");
    const int version = static_cast<unsigned char>(bytes[6]);
    if (version < 1 || version > 3)
      throw array_.place.error(fmt::format("unknown version {}", version));
    const std::size_t size_bytes = version == 1 ? 2 : 4;
    if (bytes.size() < size_at + size_bytes) throw array_.place.error("ends in its head");
    std::size_t size = 0;
    for (std::size_t i = size_bytes; i-- > 0;)
      size = size << 8 | static_cast<unsigned char>(bytes[size_at + i]);
    array_.elements = size_at + size_bytes;
    if (size > bytes.size() - array_.elements) throw array_.place.error("ends in its head");
    const std::string_view text = bytes.substr(array_.elements, size);
    array_.elements += size;
    return text;
  }

  void set_type(std::string_view type) {
    const bool has_order = type.find_first_of("<>=|") == 0;
    array_.is_big_endian = type.front() == '>';
    const std::string_view rest = type.substr(has_order ? 1 : 0);
    std::size_t size = 0;
    bool is_known = rest.size() >= 2 && rest.size() <= 8;
    for (const char c : rest.substr(std::min<std::size_t>(1, rest.size()))) {
      is_known = is_known && c >= '0' && c <= '9';
      size = 10 * size + static_cast<std::size_t>(c - '0');
    }
    array_.kind = rest.empty() ? '?' : rest.front();
    array_.item_bytes = array_.kind == 'U' ? 4 * size : size;
    if (is_known && is_read()) return;
    throw array_.place.error(fmt::format("elements of type {} are not read; numbers and texts are",
                                         type == "?" ? "with fields" : quote(type)));
  }

  bool is_read() const {
    const auto size_is = [&](std::initializer_list<std::size_t> sizes) {
      return std::find(sizes.begin(), sizes.end(), array_.item_bytes) != sizes.end();
    };
    switch (array_.kind) {
      case 'f':
        return size_is({2, 4, 8});
      case 'i':
      case 'u':
        return size_is({1, 2, 4, 8});
      case 'b':
        return size_is({1});
      default:
        return (array_.kind == 'U' || array_.kind == 'S') && array_.item_bytes > 0;
    }
  }

  void check_size() const {
    const std::size_t room = (array_.content.size() - array_.elements) / array_.item_bytes;
    const bool is_empty =
        std::find(array_.shape.begin(), array_.shape.end(), std::size_t{0}) != array_.shape.end();
    std::size_t count = is_empty ? 0 : 1;
    for (const std::size_t extent : array_.shape) {
      if (count > room / std::max<std::size_t>(extent, 1))
        throw array_.place.error("ends before its last element");
      count *= extent;
    }
    if (count > room) throw array_.place.error("ends before its last element");
    if (count < room) throw array_.place.error("goes on behind its last element");
  }

  NpyArray array_;
};

}  // namespace

NpyArray read_npy(std::string content, NpyPlace place) {
  return NpyReader(std::move(content), std::move(place)).read();
}

}  // namespace kinemend
