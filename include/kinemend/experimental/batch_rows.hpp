// The results of a batch: a row for each take, and sums over them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/report.hpp"

namespace kinemend {

/// A take of a batch: what its report says without lists.
struct BatchRow {
  std::string name;    ///< below the output folder
  std::string status;  ///< "begun", "cleaned", "failed", "copied"
  std::string input;
  std::string verdict;
  std::string error;  ///< of one that failed
  std::vector<std::string> warnings;
  std::size_t frames = 0;
  std::size_t frames_repaired = 0;
  std::size_t spikes = 0;
  std::size_t gaps = 0;
  double frame_rate_hz = 0;
  double seconds = 0;
  std::string json;  ///< all of it, on one line without its end
};
/// A take of which there is nothing to say yet, or ever.
BatchRow plain_row(std::string_view name, std::string_view status);
/// `warnings`: also those of reading and writing, in place of the report's own.
BatchRow cleaned_row(std::string_view name, const Report& report,
                     const std::vector<std::string>& warnings);
BatchRow failed_row(std::string_view name, std::string_view input, std::string_view error,
                    int exit_code, const std::vector<std::string>& warnings = {});
/// None for what is no row.
std::optional<BatchRow> parse_row(std::string_view json);

/// The rows that most should be looked at, worst first: takes with warnings, then by the share of
/// frames repaired. What failed is not among them.
std::vector<BatchRow> worst_rows(std::span<const BatchRow> rows, std::size_t most = 10);

/// Sums over all takes of a batch, whichever run made them.
struct BatchSums {
  std::size_t takes = 0, cleaned = 0, failed = 0, to_do = 0;
  std::size_t frames = 0, spikes = 0, gaps = 0;
  double duration_s = 0, seconds = 0;
  std::vector<std::pair<std::string, std::string>> failures;  ///< name and error

  /// `row`: nullptr where the take is still to be done.
  void add(std::string_view name, const BatchRow* row);
};
/// The summary as a document of its own.
std::string to_json(const BatchSums& sums, std::string_view options_hash);

/// What one run did.
struct BatchCounts {
  std::size_t cleaned = 0;  ///< by this run
  std::size_t kept = 0;     ///< done by an earlier one
  std::size_t copied = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;    ///< of those that did not fail
  std::size_t part = 1, parts = 1;  ///< of the whole batch
  int exit_code = 0;                ///< the highest of all

  void add(const BatchRow& row, bool is_new, int code);
};
std::string to_text(const BatchCounts& counts, const BatchSums& sums,
                    std::span<const BatchRow> worst);

}  // namespace kinemend
