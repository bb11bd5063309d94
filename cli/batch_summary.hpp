// Writes the rows of a batch, and sums over all its takes.
#pragma once

#include <string>
#include <vector>

#include "batch_list.hpp"
#include "kinemend/experimental/batch_rows.hpp"

namespace kinemend::cli {

/// Appends a row to `rows.jsonl`, or to `rows.I-of-N.jsonl` for a shard, at once: a run that is
/// killed has written the rows of all takes that it finished.
void append_row(const std::string& folder, const Shard& shard, const BatchRow& row);
/// Rewrites the rows: one line per take, sorted by name. Rows of takes that are not in this batch
/// are kept as long as they count (`still_counts`).
void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<BatchRow>& rows);

/// Sums over the records of all takes of the batch, whichever run or shard made them, over those
/// that are still to be done, and over those that other batches wrote to the same folder.
BatchSums sums_of(const std::string& folder, const std::vector<BatchItem>& all,
                  const std::string& options_hash);
/// As `summary.json`.
void write_summary(const std::string& folder, const std::string& summary);

}  // namespace kinemend::cli
