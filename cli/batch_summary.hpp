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
  int exit_code = 0;  ///< the highest of all

  void add(const Json& row, bool is_new, int code);
};

/// `rows.jsonl`, or `rows.I-of-N.jsonl` for a part: a line a take, sorted by name.
void write_rows(const std::string& folder, const Shard& shard, const std::vector<Json>& rows);

/// Sums over the records of all takes of the batch, whichever run or shard made them, and what is
/// still to be done.
Json summary_of(const std::string& folder, const std::vector<BatchItem>& all,
                const std::string& options_hash);
/// As `summary.json`.
void write_summary(const std::string& folder, const Json& summary);

std::string summary_text(const BatchCounts& counts, const Json& summary, const Shard& shard);

}  // namespace kinemend::cli
