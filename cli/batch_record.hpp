// Records what a batch did with each take, so that it can resume: one small file per take below
// `.kinemend/` in the output folder, written after the result. Writes the rows of a batch, and sums
// over all its takes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch_list.hpp"
#include "command.hpp"
#include "kinemend/extend/pages.hpp"
#include "platform/system.hpp"

namespace kinemend::cli {

/// Everything that a result depends on.
struct BatchKey {
  std::string input;    ///< hash of the take's bytes, and of its skeleton's where it has one
  std::string options;  ///< hash of every setting
  std::string version;
  friend bool operator==(const BatchKey&, const BatchKey&) = default;
};

struct BatchRecord {
  std::string input;  ///< absolute path of the take; empty if unknown
  BatchKey key;
  std::string output;  ///< hash of the result's bytes; empty without a result
  BatchRow row;
};

/// `name` with `extension` appended. File systems allow 255 bytes for the last part of a path; a
/// longer one is cut and ends with a hash of the whole name.
std::string extended_name(const std::string& name, std::string_view extension);

std::string record_path(const std::string& folder, const std::string& name);
/// Returns nullopt if there is no record or it cannot be read.
std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name);
void write_record(const std::string& folder, const std::string& name, const BatchRecord& record);

/// The names of all takes and copied skeletons with records in a folder, sorted.
std::vector<std::string> recorded_names(const std::string& folder);
/// Returns whether the record of a take is included in sums: its result exists, or it failed and
/// its input exists.
bool still_counts(const std::string& folder, const std::string& name, const BatchRecord& record);

/// Makes a folder and its parents. Errors: `ErrorKind::cannot_write`, also if a file has its name.
void make_folder(const std::filesystem::path& folder);
/// The folders of a path that do not exist, innermost first.
std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& folder);

/// Keeps other threads and processes from working on the take `name` of the batch in `folder`,
/// during its lifetime.
class TakeLock {
 public:
  TakeLock(const std::string& folder, const std::string& name);

 private:
  std::optional<platform::FileLock> lock_;
};

/// Removes temporary files of killed runs: files of this program in `folder` and below that are
/// older than an hour and whose process has ended.
void remove_leftovers(const std::string& folder);

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

/// `batch --merge ROWS... -o DIR`: reads files of rows and writes `rows.jsonl` and `summary.json`
/// into DIR. Returns the exit code of a single run over all takes, or that of an unreadable input
/// if shards or takes are missing. Errors: `ErrorKind::usage` for options that do not concern rows;
/// `unreadable_input` for a file without rows, for a take with different rows in two files, and for
/// shards with different settings; `cannot_write` for existing files that a batch did not write.
int merge_batch(const Arguments& arguments);

}  // namespace kinemend::cli
