// Keeps an npz file as it was read, and names the arrays of its layout.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/npz/npy_array.hpp"
#include "io/npz/zip_archive.hpp"
#include "kinemend/error.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

inline constexpr std::string_view npz_layout = "kinemend-1";

struct NpzDocument : SourceDocument {
  std::string bytes;
  ZipArchive archive;
  double rate_when_unknown_hz = 0;  ///< for a file without a usable rate
  std::size_t max_depth = 0;        ///< of joints
};

/// The array of that name, unpacked; none where the archive has none. `left_bytes` is what may
/// still be unpacked, and becomes less. Errors: `unreadable_input`.
std::optional<NpyArray> npz_array(const NpzDocument& document, const std::string& name,
                                  std::size_t& left_bytes);
/// Arrays that the layout does not know, by name.
std::vector<std::string> other_npz_arrays(const NpzDocument& document);

/// What had to be repaired, by the name of the repair: how often, and in which array first.
struct NpzRepair {
  std::string kind;
  std::string message;
  std::size_t count = 0;
};
struct NpzTake {
  Take take;
  std::vector<NpzRepair> repairs;
};
/// Decodes the motion: the same numbers each time. Errors: `unreadable_input`.
NpzTake take_of_npz(const NpzDocument& document);

}  // namespace kinemend
