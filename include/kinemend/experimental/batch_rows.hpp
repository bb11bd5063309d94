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

/// A take of a batch: the summary of its report, without lists.
struct BatchRow {
  std::string name;  ///< path below the output folder
  /// "begun", "cleaned", "failed", "copied"; a take that was only filled or converted is "cleaned".
  std::string status;
  std::string input;
  std::string verdict;
  std::string error;  ///< why the take failed; else empty
  std::vector<std::string> warnings;
  std::size_t frames = 0;
  std::size_t frames_repaired = 0;
  std::size_t spikes = 0;
  std::size_t gaps = 0;
  double frame_rate_hz = 0;
  double seconds = 0;
  std::string json;  ///< the whole row on one line, without the line end
};
/// Makes the row of a take without results, which was begun or copied.
BatchRow plain_row(std::string_view name, std::string_view status);
/// Makes the row of a cleaned take. `warnings` replaces the report's own list and includes warnings
/// of reading and writing.
BatchRow cleaned_row(std::string_view name, const Report& report,
                     const std::vector<std::string>& warnings);
BatchRow failed_row(std::string_view name, std::string_view input, std::string_view error,
                    int exit_code, const std::vector<std::string>& warnings = {});
/// Returns a row, or empty if the text is not a row.
std::optional<BatchRow> parse_row(std::string_view json);

/// Returns the takes that most need review, worst first: takes with warnings, then by the share of
/// frames repaired. Failed takes are left out.
std::vector<BatchRow> worst_rows(std::span<const BatchRow> rows, std::size_t most = 10);

/// Sums over all takes of a batch, over all runs.
struct BatchSums {
  std::size_t takes = 0, cleaned = 0, failed = 0, to_do = 0;
  std::size_t frames = 0, spikes = 0, gaps = 0;
  double duration_s = 0, seconds = 0;
  std::vector<std::pair<std::string, std::string>> failures;  ///< name and error

  /// Adds a take. `row`: nullptr if the take has not been cleaned yet.
  void add(std::string_view name, const BatchRow* row);
};
/// Returns the summary as a separate document.
std::string to_json(const BatchSums& sums, std::string_view options_hash);

/// Counts of one run.
struct BatchCounts {
  std::string_view work = "cleaned";  ///< what this run did with its takes: "filled", "converted"
  std::size_t cleaned = 0;            ///< takes done by this run
  std::size_t kept = 0;               ///< done by an earlier run
  std::size_t copied = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;    ///< takes with warnings that did not fail
  std::size_t part = 1, parts = 1;  ///< this run cleans part `part` of `parts` of the batch
  int exit_code = 0;                ///< the highest exit code of all takes

  void add(const BatchRow& row, bool is_new, int code);
};
std::string to_text(const BatchCounts& counts, const BatchSums& sums,
                    std::span<const BatchRow> worst);

}  // namespace kinemend
