#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "batch_list.hpp"
#include "json.hpp"

namespace kinemend::cli {

/// What one run did.
struct BatchCounts {
  std::size_t cleaned = 0;  ///< by this run
  std::size_t kept = 0;     ///< done by an earlier one
  std::size_t copied = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;  ///< of those that did not fail
  int exit_code = 0;              ///< the highest of all

  void add(const Json& row, bool is_new, int code);
};

/// Puts a row behind those of `rows.jsonl`, or `rows.I-of-N.jsonl` for a part, at once: what is
/// done is known whenever the run ends.
void append_row(const std::string& folder, const Shard& shard, const Json& row);
/// The rows anew: a line a take, sorted by name. Rows of takes that are not of this batch stay as
/// long as they count (`still_counts`).
void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<Json>& rows);

/// Sums over the records of all takes of the batch, whichever run or shard made them, and what is
/// still to be done; and over those that other batches have made in the same folder.
Json summary_of(const std::string& folder, const std::vector<BatchItem>& all,
                const std::string& options_hash);
/// As `summary.json`.
void write_summary(const std::string& folder, const Json& summary);

/// The ten rows that most should be looked at, worst first: takes with warnings, then by the share
/// of frames repaired. What failed is said elsewhere.
std::vector<Json> worst_rows(const std::vector<Json>& rows);

std::string summary_text(const BatchCounts& counts, const Json& summary, const Shard& shard,
                         const std::vector<Json>& worst);

}  // namespace kinemend::cli
