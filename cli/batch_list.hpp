// The takes of a batch and the paths of their results.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli {

/// One file of a batch.
struct BatchItem {
  std::string input;       ///< path to read
  std::string name;        ///< path below the output folder, with / between its parts
  bool is_copied = false;  ///< a skeleton file (ASF), which the takes in its folder need
};

/// Part `index` (from 1) of `count`.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;
};

/// "2/8". Errors: `ErrorKind::usage`.
Shard parse_shard(const std::string& text);
/// Whether a take belongs to the shard. Only its name decides, so that every machine splits a tree
/// in the same way.
bool in_shard(std::string_view name, const Shard& shard);

/// The folders among the inputs that hold no take whose file name matches the pattern.
std::vector<std::string> empty_folders(const std::vector<std::string>& inputs,
                                       const std::string& output, const std::string& pattern);

/// The takes in folders and below, and files given by name, sorted by name. Hidden files, the
/// folder `output`, and tables that hold no take are skipped. In a folder, only files whose name
/// matches `pattern` (shell style; empty: all) are used. The name of a take is its path below its
/// folder; that of a file given by name is the path as given, which must be relative and stay below
/// the current folder. Errors: `unreadable_input` for a path that does not exist; `usage` if two
/// takes would be written to the same place.
std::vector<BatchItem> find_items(const std::vector<std::string>& inputs, const std::string& output,
                                  const std::string& pattern);

/// The given files, and the takes below the given folders, sorted by name. Errors:
/// `unreadable_input` for a folder that cannot be read.
std::vector<std::string> takes_below(const std::vector<std::string>& inputs);

/// The lines of a list of files in UTF-8; blank lines and `#` comments are skipped. `name` is for
/// messages. Errors: `unreadable_input` for UTF-16, and with the line for a NUL byte.
std::vector<std::string> listed_inputs(std::string_view text, std::string_view name);

}  // namespace kinemend::cli
