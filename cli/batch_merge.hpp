// Puts the rows of the shards of a batch together: the rows and sums of one run.
#pragma once

#include "command.hpp"

namespace kinemend::cli {

/// `batch --merge ROWS... -o DIR`: reads files of rows and writes `rows.jsonl` and `summary.json`
/// into DIR. Returns the exit code of one run over all takes; that of an unreadable input also
/// where shards or takes are missing. Errors: `ErrorKind::usage` for options that do not concern
/// rows; `unreadable_input` for a file without rows, for a take that two files tell differently,
/// and for shards that were made with different settings; `cannot_write` for files of others.
int merge_batch(const Arguments& arguments);

}  // namespace kinemend::cli
