// The bytes of a C3D file while it is read: words and reals in the number formats of Intel, DEC and
// MIPS, errors and repairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/portable.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

/// The processor type whose number formats a C3D file uses; the values are the codes in byte 4 of
/// its parameter section.
enum class C3dProcessor : std::uint8_t { intel = 84, dec = 85, mips = 86 };

// By definition of the format.
inline constexpr std::size_t most_in_a_word = 65535;

/// The largest real of VAX, whose reals have the smallest range.
constexpr double largest_c3d_real = 1.7014117e38;

/// Converts a VAX F float, halves in numerical order, to an IEEE float. Exponent 0 is zero.
inline float from_vax(std::uint32_t bits) {
  const std::uint32_t exponent = (bits >> 23) & 255;
  const float small = bits_as<float>(bits & (exponent > 2 ? 0u : ~0u)) * 0.25f;
  return exponent > 2 ? bits_as<float>(bits - (2u << 23)) : exponent == 0 ? 0.0f : small;
}

/// Returns the nearest VAX F float. A value that is too large becomes the largest float; NaN
/// becomes zero.
inline std::uint32_t to_vax(float value) {
  const std::uint32_t bits = bits_as<std::uint32_t>(value);
  const std::uint32_t sign = bits & 0x80000000u, exponent = (bits >> 23) & 255;
  if (exponent == 255 && (bits & 0x7FFFFFu) != 0) return 0;
  if (exponent >= 254) return sign | 0x7FFFFFFFu;
  if (exponent > 0) return bits + (2u << 23);
  const float scaled = value * 4;  // exact, and a normal number unless no VAX float is that small
  return bits_as<std::uint32_t>(scaled) << 1 >> 24 == 0 ? 0 : bits_as<std::uint32_t>(scaled);
}

/// The 16-bit words and 32-bit reals of one processor type.
template <C3dProcessor processor>
struct C3dWords {
  static std::uint16_t word(const char* p) {
    const auto byte = [&](std::size_t i) {
      return static_cast<unsigned>(static_cast<unsigned char>(p[i]));
    };
    return static_cast<std::uint16_t>(processor == C3dProcessor::mips ? byte(0) << 8 | byte(1)
                                                                      : byte(1) << 8 | byte(0));
  }
  static float real(const char* p) {
    const std::uint32_t first = word(p), second = word(p + 2);
    if constexpr (processor == C3dProcessor::dec) return from_vax(first << 16 | second);
    return bits_as<float>(processor == C3dProcessor::mips ? first << 16 | second
                                                          : second << 16 | first);
  }
  static void put_word(char* p, std::uint16_t value) {
    const char low = static_cast<char>(value & 255), high = static_cast<char>(value >> 8);
    p[0] = processor == C3dProcessor::mips ? high : low;
    p[1] = processor == C3dProcessor::mips ? low : high;
  }
  static void put_real(char* p, float value) {
    const std::uint32_t bits =
        processor == C3dProcessor::dec ? to_vax(value) : bits_as<std::uint32_t>(value);
    const auto low = static_cast<std::uint16_t>(bits),
               high = static_cast<std::uint16_t>(bits >> 16);
    put_word(p, processor == C3dProcessor::intel ? low : high);
    put_word(p + 2, processor == C3dProcessor::intel ? high : low);
  }
};

/// Calls `action` with the `C3dWords` of `processor`.
template <class Action>
auto with_words(C3dProcessor processor, Action&& action) {
  switch (processor) {
    case C3dProcessor::dec:
      return action(C3dWords<C3dProcessor::dec>{});
    case C3dProcessor::mips:
      return action(C3dWords<C3dProcessor::mips>{});
    case C3dProcessor::intel:
      break;
  }
  return action(C3dWords<C3dProcessor::intel>{});
}

constexpr std::size_t c3d_block_bytes = 512;

/// Returns the offset of a word in the header; words are numbered from 1, as in the format's
/// manual.
constexpr std::size_t c3d_word_offset(std::size_t word) { return 2 * (word - 1); }

/// The bytes of a C3D file that is being read, and its repairs. Callers check that a word is within
/// the file before they read it.
struct C3dSource {
  std::string_view name;
  std::string_view bytes;
  bool strict = false;
  Diagnostics& diagnostics;
  C3dProcessor processor = C3dProcessor::intel;

  /// Whether `count` bytes follow at `offset`.
  bool holds(std::size_t offset, std::size_t count) const {
    return offset <= bytes.size() && count <= bytes.size() - offset;
  }
  std::uint8_t byte(std::size_t offset) const { return static_cast<std::uint8_t>(bytes[offset]); }
  std::uint16_t word(std::size_t offset) const {
    return with_words(processor, [&](auto words) { return words.word(bytes.data() + offset); });
  }
  float real(std::size_t offset) const {
    return with_words(processor, [&](auto words) { return words.real(bytes.data() + offset); });
  }

  Error error_at(std::size_t offset, std::string_view message) const {
    return Error::at_byte(name, offset, message);
  }
  /// Notes a repair, unless `count` is 0; throws `ErrorKind::quality_limit` when the reading is
  /// strict.
  void note(std::string_view kind, std::size_t offset, std::string_view message,
            std::size_t count = 1) const;
};

}  // namespace kinemend
