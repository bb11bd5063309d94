// The format BVH: recognises, reads and writes it.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is BVH, 0 to 100.
int sniff_bvh(std::string_view head);
/// Reads BVH in all its dialects. Errors: `unreadable_input` with the line.
TakeResult read_bvh(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from BVH keeps its source's layout and the digits of every unchanged
/// sample; any other clip gets a plain layout. Errors: `usage` if the format cannot hold the clip.
std::string write_bvh(const Take& clip);

}  // namespace kinemend
