// The format npz: recognises, reads and writes takes as archives of NumPy arrays, and keeps a file
// as it was read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/npz/npy_array.hpp"
#include "io/npz/zip_archive.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is an npz archive, 0 to 100.
int sniff_npz(std::string_view head);
/// Reads a take of joints or markers in the layout of docs/formats/npz.md. Errors:
/// `unreadable_input` with the byte of the member at fault.
TakeResult read_npz(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a take. A take that was read from npz is written as the same archive with new contents in
/// the changed arrays; any other take as a new archive. Errors: `usage` for a file of 4 GiB or
/// more.
std::string write_npz(const Take& take);
/// Lists the data besides the motion that is lost if the take needs a new archive; empty if its
/// source is rewritten or is of another format.
std::vector<std::string> lost_beside_npz(const Take& take);

inline constexpr std::string_view npz_layout = "kinemend-1";

struct NpzDocument : SourceDocument {
  std::string bytes;
  ZipArchive archive;
  double rate_when_unknown_hz = 0;  ///< for a file without a usable rate
  std::size_t max_depth = 0;        ///< deeper nesting of joints is an error
};

/// Returns the unpacked array of that name, or empty. `left_bytes` is the number of bytes that may
/// still be unpacked; it is reduced by the array's size. Errors: `unreadable_input`.
std::optional<NpyArray> npz_array(const NpzDocument& document, const std::string& name,
                                  std::size_t& left_bytes);
/// Returns the names of arrays that are not part of the layout.
std::vector<std::string> other_npz_arrays(const NpzDocument& document);

/// Decodes the motion: the result is the same each time. Errors: `unreadable_input`.
TakeResult take_of_npz(const NpzDocument& document);

}  // namespace kinemend
