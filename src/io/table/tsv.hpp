// The tables of Qualisys Track Manager (TSV): recognises, reads and writes them.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// How likely the head of a file is a table of Qualisys Track Manager, 0 to 100.
int sniff_tsv(std::string_view head);
/// Reads marker tables (docs/formats/tsv.md). Errors: `unreadable_input`, naming the line; also for
/// tables of anything else: rigid bodies, skeletons, analog channels.
TakeResult read_tsv(std::string bytes, std::string_view name, const ReadOptions& options);
/// A clip read from such a file comes out in its source's layout, with the digits of every sample
/// that has not changed; any other in a plain layout. Errors: `usage` when the format cannot hold
/// the clip: it is in millimetres.
std::string write_tsv(const Take& clip);

}  // namespace kinemend
