// The format C3D: recognises, reads and writes it, and names what it cannot keep.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is C3D, 0 to 100.
int sniff_c3d(std::string_view head);
/// Reads C3D of every processor type and number format. Errors: `unreadable_input`, naming the
/// byte.
TakeResult read_c3d(std::string bytes, std::string_view name, const ReadOptions& options);
/// A clip read from C3D comes out as its source's own bytes with every changed sample replaced, in
/// the source's processor type and number format; one with other frames, markers, events or units,
/// or with samples too large for the source's integers, as a new file of Intel floats that keeps
/// the source's parameters. Errors: `usage` when the format cannot hold the clip.
std::string write_c3d(const Take& clip);
/// The parts of the source that `write_c3d` leaves out.
Diagnostics lost_in_c3d(const Take& clip);
/// The parts of a C3D file that no other format can hold, in words: "2 force plates".
std::vector<std::string> c3d_beside_points(const SourceInfo& source);

}  // namespace kinemend
