// Remembers what a batch did with each take, so that it can be resumed: one small file per take
// below `.kinemend/` in the output folder, written after the result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/batch_rows.hpp"
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
  std::string input;  ///< path of the take, absolute; empty where it is not known
  BatchKey key;
  std::string output;  ///< hash of the result's bytes; empty where there is none
  BatchRow row;
};

/// `name` with `extension` behind it. File systems allow 255 bytes for the last part of a path: one
/// that would be longer is cut, and ends with a hash of the whole name.
std::string extended_name(const std::string& name, std::string_view extension);

std::string record_path(const std::string& folder, const std::string& name);
/// None if there is no record, or if it cannot be read.
std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name);
void write_record(const std::string& folder, const std::string& name, const BatchRecord& record);

/// The names of all takes, and of copied skeletons, that a folder holds records of, sorted.
std::vector<std::string> recorded_names(const std::string& folder);
/// Whether the record of a take still counts in sums: its result exists, or it failed and its input
/// exists.
bool still_counts(const std::string& folder, const std::string& name, const BatchRecord& record);

/// Makes a folder and those above it. Errors: `ErrorKind::cannot_write`, also if a file has its
/// name.
void make_folder(const std::filesystem::path& folder);
/// The folders of a path that do not exist, innermost first.
std::vector<std::filesystem::path> missing_folders(const std::filesystem::path& folder);

/// While it lives, no other thread or process works on the take `name` of the batch in `folder`.
class TakeLock {
 public:
  TakeLock(const std::string& folder, const std::string& name);

 private:
  std::optional<platform::FileLock> lock_;
};

/// Removes temporary files that a killed run may have left: files of this program in `folder` and
/// below that are older than an hour and whose process is gone.
void remove_leftovers(const std::string& folder);

}  // namespace kinemend::cli
