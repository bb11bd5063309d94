// The files of one run, so that no output replaces what the run needs.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend::cli {

/// All files that a run reads and writes. Each command that writes lists them here before it works:
///
///     RunFiles()
///         .reads("IN", input)
///         .reads("--gaps", arguments.text("gaps"))  // an empty path is ignored
///         .writes("--output", output, input)        // with --force it may replace its own input
///         .writes("--report", report)
///         .check(arguments.flag("json"));
///
/// `check` refuses an output that is the file of an input or of another output. Two paths name the
/// same file if the system says so: symlinks, hard links and relative paths are followed, even for
/// a file that does not exist yet. `--force` does not help, because it only replaces results of an
/// earlier run. `-` is a standard stream, which can be read once and written once.
class RunFiles {
 public:
  /// `option` is the user's name for the file: "--gaps", or "IN" for an input without an option.
  RunFiles& reads(std::string option, std::string path);
  RunFiles& reads(const std::string& option, const std::vector<std::string>& paths);
  /// `replaces` is the input that this output may replace, such as the take that is cleaned in
  /// place.
  RunFiles& writes(std::string option, std::string path, std::string replaces = {});
  /// A file that this run would write (`--dry-run`); no output may have the same path.
  RunFiles& would_write(std::string option, std::string path);

  /// `json_to_out` means that standard output holds JSON. Errors: `ErrorKind::usage` with both
  /// options and the path.
  void check(bool json_to_out = false) const;

 private:
  struct File {
    std::string option;
    std::string path;
    std::string replaces{};
    bool is_written = true;  // applies to outputs
  };

  void check_streams(bool json_to_out) const;
  static void refuse_input(const File& output, const File& input);

  std::vector<File> inputs_, outputs_;
};

/// The results of the inputs of one run, no two of which may share a path.
class ResultPaths {
 public:
  /// `command` is named in the message.
  explicit ResultPaths(std::string command) : command_(std::move(command)) {}
  /// Errors: `ErrorKind::usage` if the result is already that of another input.
  void add(const std::string& result, const std::string& input);

 private:
  std::string command_;
  std::map<std::string, std::string> inputs_;  // by result
};

/// Returns whether both paths name one file, even if it does not exist yet. Streams (`-`) and empty
/// paths are not files.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace kinemend::cli
