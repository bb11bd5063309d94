#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Which takes a batch is about, and where their results go.
namespace kinemend::cli {

/// One file of a batch.
struct BatchItem {
  std::string input;       ///< path to read
  std::string name;        ///< path below the output folder, with / between its parts
  bool is_copied = false;  ///< a skeleton file (ASF), which the takes beside it need
};

/// Part `index` (from 1) of `count`.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;
};

/// "2/8". Errors: `ErrorKind::usage`.
Shard parse_shard(const std::string& text);
/// Whether a take belongs to the shard: by its name alone, so that every machine splits a tree
/// alike whatever else lies in it.
bool in_shard(std::string_view name, const Shard& shard);

/// The folders among the inputs that hold no take of that pattern.
std::vector<std::string> empty_folders(const std::vector<std::string>& inputs,
                                       const std::string& output, const std::string& pattern);

/// The takes in folders (all that lies below, hidden files and `output` itself left out, and of
/// tables only those that hold a take), and files by name. The name of a take is its path below its
/// folder; of a file that was named it is the path as it was given, which then is relative and does
/// not climb. `pattern` (shell style, of the file name) narrows the folders. Sorted by name.
/// Errors: `unreadable_input` for what does not exist; `usage` where two would be written to one
/// place.
std::vector<BatchItem> find_items(const std::vector<std::string>& inputs, const std::string& output,
                                  const std::string& pattern);

/// The files named and, of folders, the takes below them, by name. Errors: `unreadable_input` for a
/// folder that cannot be read.
std::vector<std::string> takes_below(const std::vector<std::string>& inputs);

/// The lines of a list of files; blank lines and `#` comments are left out.
std::vector<std::string> listed_inputs(std::string_view text);

}  // namespace kinemend::cli
