// Records what a batch did with each take, so that it can resume: one small file per take below
// `.kinemend/` in the output folder, written after the result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace kinemend::cli
