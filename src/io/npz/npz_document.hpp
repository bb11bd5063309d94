// Keeps an npz file as it was read, and names the arrays of its layout.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/npz/npy_array.hpp"
#include "io/npz/zip_archive.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

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
