// The format FBX: recognises, reads and writes it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is FBX, binary or text, 0 to 100.
int sniff_fbx(std::string_view head);
/// Reads one animation of an FBX file of version 6 or 7 (`ReadOptions::animation`). Errors:
/// `unreadable_input` with the byte or line, also for a file without joints; `usage` for an
/// animation that the file does not have.
TakeResult read_fbx(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a take. A take that was read from FBX is written as the same file with new keys in the
/// curves of changed joints; any other take as a new binary file of version 7.5. Markers are nulls,
/// and a missing sample has the last known position of its marker, or the first. Errors: `usage` if
/// the file cannot hold the change: the joint's curves also move other joints, or several layers
/// move it.
std::string write_fbx(const Take& take);
/// Writes a take as a new binary file of version 7.5: limbs or nulls, one animation of one layer, a
/// key per frame, and the curves as animated properties of the first joint. Errors: `usage` for an
/// invalid take.
std::string new_fbx_file(const Take& take, std::span<const NamedCurve> curves = {});
/// Lists the data besides the motion that is lost if the take needs a new file; empty if its source
/// is rewritten or is of another format.
std::vector<std::string> lost_beside_fbx(const Take& take);

}  // namespace kinemend
