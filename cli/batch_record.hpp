#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/experimental/batch_rows.hpp"

// What a batch remembers of each take, so that it can be taken up again: one small file a take
// below
// `.kinemend/` in the output folder, written after the result.
namespace kinemend::cli {

/// All that a result depends on.
struct BatchKey {
  std::string input;    ///< hash of the take's bytes, and of its skeleton's where it has one
  std::string options;  ///< hash of every setting
  std::string version;
  friend bool operator==(const BatchKey&, const BatchKey&) = default;
};

struct BatchRecord {
  BatchKey key;
  std::string output;  ///< hash of the result's bytes; empty where there is none
  BatchRow row;
};

std::string record_path(const std::string& folder, const std::string& name);
/// None where there is no record or it cannot be understood.
std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name);
void write_record(const std::string& folder, const std::string& name, const BatchRecord& record);

/// The names of all takes that a folder holds records of, sorted.
std::vector<std::string> recorded_names(const std::string& folder);
/// Whether a take of another batch into the same folder is still one: its result stands there, or
/// it failed and its input is still there.
bool still_counts(const std::string& folder, const std::string& name, const BatchRecord& record);

/// Makes a folder and those above it. Errors: `ErrorKind::cannot_write`, also where a file stands
/// in its place.
void make_folder(const std::filesystem::path& folder);

/// While it lives nobody else works on the take `name` of the batch in `folder`, in this process or
/// in another one.
class TakeLock {
 public:
  TakeLock(const std::string& folder, const std::string& name);
  ~TakeLock();
  TakeLock(const TakeLock&) = delete;
  TakeLock& operator=(const TakeLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Removes what a run that was killed may have left under a temporary name: files of this program
/// in `folder` and below that are older than an hour and whose process is gone.
void remove_leftovers(const std::string& folder);

}  // namespace kinemend::cli
