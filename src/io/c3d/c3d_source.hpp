// The bytes of a C3D file while it is read: words, reals, errors and repairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/c3d/c3d_words.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

constexpr std::size_t c3d_block_bytes = 512;

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
  /// Notes a repair; throws `ErrorKind::quality_limit` when the reading is strict.
  void note(std::string_view kind, std::size_t offset, std::string_view message,
            std::size_t count = 1) const;
};

}  // namespace kinemend
