// Reads and writes zip archives, as NumPy writes them: finds their members, unpacks them, and packs
// others (PKWARE's APPNOTE 6.3, section 4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// A member of an archive and its offsets in the bytes.
struct ZipMember {
  std::string name;
  std::size_t begin = 0;  ///< offset of its local header
  std::size_t end = 0;    ///< beginning of the next member, or of the directory
  std::size_t data = 0;   ///< offset of its packed bytes
  std::size_t packed_bytes = 0;
  std::size_t raw_bytes = 0;
  std::uint32_t checksum = 0;
  std::uint16_t packing = 0;
  std::uint16_t flags = 0;
  std::size_t entry = 0;  ///< offset of its entry in the directory
  std::size_t entry_bytes = 0;
};

struct ZipArchive {
  std::string name;  ///< name of the file, for messages
  std::vector<ZipMember> members;
  std::size_t directory = 0;
  std::size_t directory_end = 0;

  /// Returns the member of that name, or null.
  const ZipMember* find(std::string_view member) const;
};

/// Reads the directory of an archive below 4 GiB. Errors: `unreadable_input` with the byte, also
/// for members that overlap or share a name.
ZipArchive read_zip(std::string_view bytes, std::string_view name);
/// Returns the unpacked bytes of a member. Errors: `unreadable_input` if it is damaged, encrypted,
/// packed by a method other than stored and deflated, or larger than `most_bytes`.
std::string zip_content(std::string_view bytes, const ZipArchive& archive, const ZipMember& member,
                        std::size_t most_bytes);

/// A member to write.
struct ZipContent {
  std::string name;
  std::string bytes;
  bool is_deflated = false;
};
/// Returns a new archive. Errors: `usage` above 4 GiB.
std::string make_zip(const std::vector<ZipContent>& contents);
/// Returns the archive with new contents for the members of these names, which stay stored or
/// deflated; names that it lacks become new members at the end. Every other member keeps its bytes.
/// Errors: as `make_zip`.
std::string rewrite_zip(std::string_view bytes, const ZipArchive& archive,
                        const std::map<std::string, std::string>& contents);

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

}  // namespace kinemend
