// The records of a zip archive, which its reader and its writer share (APPNOTE 6.3, section 4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace kinemend {

/// The first bytes of each record.
inline constexpr std::string_view zip_header_mark = "PK\3\4", zip_entry_mark = "PK\1\2",
                                  zip_end_mark = "PK\5\6";
/// Sizes of the records without names, extra fields and comments.
inline constexpr std::size_t zip_header_bytes = 30, zip_entry_bytes = 46, zip_end_bytes = 22;
inline constexpr std::uint16_t zip_stored = 0, zip_deflated = 8;
/// Marks a number that only a zip64 record can hold.
inline constexpr std::size_t zip_no_number = 0xFFFFFFFF;

/// Reads a whole number of two or four bytes, little-endian.
inline std::size_t zip_number(std::string_view bytes, std::size_t place, std::size_t size) {
  std::size_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[place + i]);
  return value;
}

/// Returns the CRC-32 of a member's unpacked bytes.
std::uint32_t zip_checksum(std::string_view raw);

}  // namespace kinemend
