// The format TRC: recognises, reads and writes it.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is TRC, 0 to 100.
int sniff_trc(std::string_view head);
/// Reads TRC in its dialects (docs/formats/trc.md). Errors: `unreadable_input` with the line.
TakeResult read_trc(std::string bytes, std::string_view name, const ReadOptions& options);
/// A clip read from TRC comes out in its source's layout, with the digits of every sample that has
/// not changed; any other in a plain layout. Errors: `usage` when the format cannot hold the clip.
std::string write_trc(const Take& clip);

}  // namespace kinemend
