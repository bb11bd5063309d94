// The files of one run, so that no output replaces what the run needs.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend::cli {

/// All files that a run reads and writes. Each command that writes names them here before it works:
///
///     RunFiles()
///         .reads("IN", input)
///         .reads("--gaps", arguments.text("gaps"))  // an empty path is ignored
///         .writes("--output", output, input)        // with --force it may replace its own input
///         .writes("--report", report)
///         .check(arguments.flag("json"));
///
/// `check` refuses an output that is the file of an input or of another output. Two paths are the
/// same file where the system says so: symlinks, hard links and relative paths are followed, also
/// for a file that does not exist yet. `--force` does not help: it replaces what an earlier run
/// left. `-` is a standard stream, which can be read once and written once.
class RunFiles {
 public:
  /// `option`: what the user calls the file, "--gaps", or "IN" for an input without an option.
  RunFiles& reads(std::string option, std::string path);
  RunFiles& reads(const std::string& option, const std::vector<std::string>& paths);
  /// `replaces`: the input that this output may replace, such as the take that is cleaned in place.
  RunFiles& writes(std::string option, std::string path, std::string replaces = {});
  /// What this run would write, but does not: no output may stand there (`--dry-run`).
  RunFiles& would_write(std::string option, std::string path);

  /// `json_to_out`: standard output holds JSON. Errors: `ErrorKind::usage` with both options and
  /// the path.
  void check(bool json_to_out = false) const;

 private:
  struct File {
    std::string option;
    std::string path;
    std::string replaces{};
    bool is_written = true;  // of outputs
  };

  void check_streams(bool json_to_out) const;
  static void refuse_input(const File& output, const File& input);

  std::vector<File> inputs_, outputs_;
};

/// Whether both paths name one file, whether it exists yet or not. Streams (`-`) and empty paths
/// are no files.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace kinemend::cli
