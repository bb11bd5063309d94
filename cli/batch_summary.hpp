#pragma once

#include <string>
#include <vector>

#include "batch_list.hpp"
#include "kinemend/experimental/batch_rows.hpp"

namespace kinemend::cli {

/// Puts a row behind those of `rows.jsonl`, or `rows.I-of-N.jsonl` for a part, at once: what is
/// done is known whenever the run ends.
void append_row(const std::string& folder, const Shard& shard, const BatchRow& row);
/// The rows anew: a line a take, sorted by name. Rows of takes that are not of this batch stay as
/// long as they count (`still_counts`).
void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<BatchRow>& rows);

/// Sums over the records of all takes of the batch, whichever run or shard made them, and what is
/// still to be done; and over those that other batches have made in the same folder.
BatchSums sums_of(const std::string& folder, const std::vector<BatchItem>& all,
                  const std::string& options_hash);
/// As `summary.json`.
void write_summary(const std::string& folder, const std::string& summary);

}  // namespace kinemend::cli
