// Parses the head of a NumPy array: a dictionary of Python as text.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/quote.hpp"
#include "io/npz/npy_array.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

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
    if (!head.read(array_)) throw error("the head of the array is damaged");
    set_type(head.type);
    check_size();
    return std::move(array_);
  }

 private:
  Error error(std::string_view message) const {
    return Error::at_byte(array_.place.file, array_.place.begin,
                          fmt::format("array {}: {}", quote(array_.place.array), message));
  }

  // Versions 2 and 3 state the size of the head in four bytes instead of two.
  std::string_view head_text() {
    const std::string_view bytes = array_.content;
    constexpr std::size_t size_at = 8;
    if (bytes.substr(0, 6) != "\x93NUMPY" || bytes.size() < size_at)
      throw error("is no array of NumPy");
    const int version = static_cast<unsigned char>(bytes[6]);
    if (version < 1 || version > 3) throw error(fmt::format("unknown version {}", version));
    const std::size_t size_bytes = version == 1 ? 2 : 4;
    if (bytes.size() < size_at + size_bytes) throw error("ends in its head");
    std::size_t size = 0;
    for (std::size_t i = size_bytes; i-- > 0;)
      size = size << 8 | static_cast<unsigned char>(bytes[size_at + i]);
    array_.elements = size_at + size_bytes;
    if (size > bytes.size() - array_.elements) throw error("ends in its head");
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
    throw error(fmt::format("elements of type {} are not read; numbers and texts are",
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
        throw error("ends before its last element");
      count *= extent;
    }
    if (count > room) throw error("ends before its last element");
    if (count < room) throw error("goes on behind its last element");
  }

  NpyArray array_;
};

}  // namespace

NpyArray read_npy(std::string content, NpyPlace place) {
  return NpyReader(std::move(content), std::move(place)).read();
}

}  // namespace kinemend
