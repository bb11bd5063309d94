// The format npz: recognises, reads and writes takes as archives of NumPy arrays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is an npz archive, 0 to 100.
int sniff_npz(std::string_view head);
/// Reads a take of joints or markers in the layout of docs/formats/npz.md. Errors:
/// `unreadable_input` with the byte of the member at fault.
TakeResult read_npz(std::string bytes, std::string_view name, const ReadOptions& options);
/// A take that was read from npz comes out as that archive with other contents in the arrays that
/// changed; any other as a new archive. Errors: `usage` for a file of 4 GiB or more.
std::string write_npz(const Take& take);
/// What the source of a take holds beside its motion, where a new file takes its place; empty where
/// the take is written in place, or comes from another format.
std::vector<std::string> lost_beside_npz(const Take& take);

}  // namespace kinemend
