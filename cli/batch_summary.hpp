// Writes the rows of a batch, and sums over all its takes.
#pragma once

#include <string>
#include <vector>

#include "batch_list.hpp"
#include "kinemend/extend/pages.hpp"

namespace kinemend::cli {

/// Appends a row to `rows.jsonl`, or to `rows.I-of-N.jsonl` for a shard, at once, so that a killed
/// run leaves the rows of all takes that it finished.
void append_row(const std::string& folder, const Shard& shard, const BatchRow& row);
/// Rewrites the rows, one line per take, sorted by name. Rows of takes outside this batch are kept
/// as long as `still_counts` holds.
void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<BatchRow>& rows);

/// Sums over the records of all takes of the batch, whichever run or shard made them, the takes
/// still to be done, and the takes that other batches wrote to the same folder.
BatchSums sums_of(const std::string& folder, const std::vector<BatchItem>& all,
                  const std::string& options_hash);
/// Writes `summary.json`.
void write_summary(const std::string& folder, const std::string& summary);

}  // namespace kinemend::cli
