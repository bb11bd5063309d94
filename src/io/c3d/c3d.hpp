// The format C3D: recognises, reads and writes it, and lists the data that cannot be kept.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is C3D, 0 to 100.
int sniff_c3d(std::string_view head);
/// Reads C3D of every processor type and number format. Errors: `unreadable_input`, naming the
/// byte.
TakeResult read_c3d(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from C3D is written as its source's bytes with every changed sample
/// replaced, in the source's processor type and number format. If frames, markers, events or units
/// differ, or samples are too large for the source's integers, it is a new file of Intel floats
/// that keeps the source's parameters. Errors: `usage` if the format cannot hold the clip.
std::string write_c3d(const Take& clip);
/// Lists the parts of the source that `write_c3d` leaves out.
Diagnostics lost_in_c3d(const Take& clip);
/// Lists the parts of a C3D file that no other format can hold: "2 force plates".
std::vector<std::string> c3d_beside_points(const SourceInfo& source);

}  // namespace kinemend
