// The format FBX: recognises, reads and writes it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is FBX, binary or text, 0 to 100.
int sniff_fbx(std::string_view head);
/// Reads one animation of an FBX file of version 6 or 7 (`ReadOptions::animation`). Errors:
/// `unreadable_input` with the byte or line, also for a file without joints; `usage` for an
/// animation that the file does not have.
TakeResult read_fbx(std::string bytes, std::string_view name, const ReadOptions& options);
/// A take that was read from FBX comes out as that file with other keys in the curves of joints
/// that changed; any other as a new binary file of version 7.5. Errors: `usage` when the file
/// cannot hold the change: a joint whose curves move other joints too, or that several layers move.
std::string write_fbx(const Take& clip);
/// What the source of a take holds beside its motion, where a new file takes its place; empty where
/// the take is written in place, or comes from another format.
std::vector<std::string> lost_beside_fbx(const Take& take);
/// Markers as nulls. A missing sample is where its marker was last, or will be first.
std::string write_fbx_markers(const Take& clip);

}  // namespace kinemend
