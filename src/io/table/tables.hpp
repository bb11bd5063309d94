// Readers and writers of tables of markers and joints: TRC, TSV, CSV.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is TRC, 0 to 100.
int sniff_trc(std::string_view head);
/// Reads TRC in its dialects (docs/formats/trc.md). Errors: `unreadable_input` with the line.
TakeResult read_trc(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from TRC keeps its source's layout and the digits of every unchanged
/// sample; any other clip gets a plain layout. Errors: `usage` if the format cannot hold the clip.
std::string write_trc(const Take& clip);

/// Returns how likely the head of a file is a table of Qualisys Track Manager, 0 to 100.
int sniff_tsv(std::string_view head);
/// Reads marker tables (docs/formats/tsv.md). Errors: `unreadable_input`, naming the line; also for
/// tables of other data: rigid bodies, skeletons, analog channels.
TakeResult read_tsv(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from such a file keeps its source's layout and the digits of every
/// unchanged sample; any other clip gets a plain layout. Errors: `usage` if the format, which is in
/// millimetres, cannot hold the clip.
std::string write_tsv(const Take& clip);

/// Returns how likely the head of a file is a CSV table of markers or joints, 0 to 100.
int sniff_csv(std::string_view head);
/// Reads tables of markers or joints (docs/formats/csv.md). Errors: `unreadable_input`, naming the
/// line.
TakeResult read_csv(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a take. A take read from CSV keeps its source's layout and the digits of every unchanged
/// sample; any other take gets a plain layout. Errors: `usage` if the format cannot hold the take.
std::string write_csv(const Take& clip);
std::string write_csv_markers(const Take& clip);
/// Describes the contents of the source table that a new file loses: "the sections Devices"; empty
/// if nothing is lost.
std::string csv_beside_markers(const Take& clip, bool as_csv);

}  // namespace kinemend
