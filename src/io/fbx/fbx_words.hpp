// Reads and writes numbers in the byte order of a binary FBX file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/bits.hpp"

namespace kinemend {

/// An unsigned integer of sizeof(Word) bytes.
template <class Word>
Word fbx_word(const char* bytes, bool big_endian) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    const std::size_t shift = 8 * (big_endian ? sizeof(Word) - 1 - i : i);
    word = static_cast<Word>(word |
                             (static_cast<Word>(static_cast<unsigned char>(bytes[i])) << shift));
  }
  return word;
}

template <class Word>
void put_fbx_word(char* bytes, Word word, bool big_endian) {
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    const std::size_t shift = 8 * (big_endian ? sizeof(Word) - 1 - i : i);
    bytes[i] = static_cast<char>((word >> shift) & 0xFF);
  }
}

inline float fbx_float(const char* bytes, bool big_endian) {
  return bits_as<float>(fbx_word<std::uint32_t>(bytes, big_endian));
}
inline double fbx_double(const char* bytes, bool big_endian) {
  return bits_as<double>(fbx_word<std::uint64_t>(bytes, big_endian));
}

}  // namespace kinemend
