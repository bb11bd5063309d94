// Reads and writes unsigned integers of any size in either byte order, and writes base64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinemend {

/// Returns the unsigned integer in sizeof(Word) bytes.
template <class Word>
Word read_word(const char* bytes, bool big_endian) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    const std::size_t shift = 8 * (big_endian ? sizeof(Word) - 1 - i : i);
    word = static_cast<Word>(word |
                             (static_cast<Word>(static_cast<unsigned char>(bytes[i])) << shift));
  }
  return word;
}

/// Writes the sizeof(Word) bytes of an unsigned integer.
template <class Word>
void put_word(char* bytes, Word word, bool big_endian) {
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    const std::size_t shift = 8 * (big_endian ? sizeof(Word) - 1 - i : i);
    bytes[i] = static_cast<char>((word >> shift) & 0xFF);
  }
}

/// Appends the sizeof(Word) bytes of an unsigned integer.
template <class Word>
void append_word(std::string& bytes, Word word, bool big_endian) {
  bytes.resize(bytes.size() + sizeof(Word));
  put_word(bytes.data() + bytes.size() - sizeof(Word), word, big_endian);
}

inline constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Returns the bytes in base64 (RFC 4648, section 4), padded.
inline std::string base64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* written = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3, written += 4) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k <= count; ++k) written[k] = base64_digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace kinemend
