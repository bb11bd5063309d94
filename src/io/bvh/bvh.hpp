// The format BVH: recognises, reads and writes it.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is BVH, 0 to 100.
int sniff_bvh(std::string_view head);
/// Reads BVH in all its dialects. Errors: `unreadable_input` with the line.
TakeResult read_bvh(std::string bytes, std::string_view name, const ReadOptions& options);
/// A clip read from BVH comes out in its source's layout, with the digits of every sample that has
/// not changed; any other in a plain layout. Errors: `usage` when the format cannot hold the clip.
std::string write_bvh(const Take& clip);

}  // namespace kinemend
