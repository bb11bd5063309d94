// Readers and writers of tables of markers and joints: TRC, TSV, CSV.
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

/// How likely the head of a file is a table of Qualisys Track Manager, 0 to 100.
int sniff_tsv(std::string_view head);
/// Reads marker tables (docs/formats/tsv.md). Errors: `unreadable_input`, naming the line; also for
/// tables of anything else: rigid bodies, skeletons, analog channels.
TakeResult read_tsv(std::string bytes, std::string_view name, const ReadOptions& options);
/// A clip read from such a file comes out in its source's layout, with the digits of every sample
/// that has not changed; any other in a plain layout. Errors: `usage` when the format cannot hold
/// the clip: it is in millimetres.
std::string write_tsv(const Take& clip);

/// How likely the head of a file is a CSV table of markers or joints, 0 to 100.
int sniff_csv(std::string_view head);
/// Reads tables of markers or joints (docs/formats/csv.md). Errors: `unreadable_input`, naming the
/// line.
TakeResult read_csv(std::string bytes, std::string_view name, const ReadOptions& options);
/// A take read from CSV comes out in its source's layout, with the digits of every sample that has
/// not changed; any other in a plain layout. Errors: `usage` when the format cannot hold the take.
std::string write_csv(const Take& clip);
std::string write_csv_markers(const Take& clip);
/// The content of the source table that a new file loses, in words: "the sections Devices"; empty
/// where nothing is lost.
std::string csv_beside_markers(const Take& clip, bool as_csv);

}  // namespace kinemend
