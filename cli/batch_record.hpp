#pragma once

#include <optional>
#include <string>
#include <vector>

#include "json.hpp"

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
  Json row;            ///< the take's line in the table of rows
};

std::string record_path(const std::string& folder, const std::string& name);
/// None where there is no record or it cannot be understood.
std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name);
void write_record(const std::string& folder, const std::string& name, const BatchRecord& record);

/// Removes what a run that was killed may have left under a temporary name: files of this program
/// in `folder` and below that are older than an hour and whose process is gone.
void remove_leftovers(const std::string& folder);

}  // namespace kinemend::cli
