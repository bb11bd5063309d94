// The format npz: recognises, reads and writes takes as archives of NumPy arrays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace kinemend
