// Merges the rows of the shards of a batch into the rows and sums of a single run.
#pragma once

#include "command.hpp"

namespace kinemend::cli {

/// `batch --merge ROWS... -o DIR`: reads files of rows and writes `rows.jsonl` and `summary.json`
/// into DIR. Returns the exit code of a single run over all takes, or that of an unreadable input
/// if shards or takes are missing. Errors: `ErrorKind::usage` for options that do not concern rows;
/// `unreadable_input` for a file without rows, for a take with different rows in two files, and for
/// shards with different settings; `cannot_write` for existing files that a batch did not write.
int merge_batch(const Arguments& arguments);

}  // namespace kinemend::cli
