// The reports of a run: each `--report FILE.html` is a page for a browser, and any other is JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/experimental/page.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "run_files.hpp"

namespace kinemend::cli {

/// Whether a report of that name is a page and no JSON.
bool is_page(const std::string& path);
/// Refuses a page that this build cannot make, or of several takes, before work is spent on it, and
/// a report named like a skeleton (FILE.asf), which an AMC file would read. Errors:
/// `ErrorKind::usage`.
void check_page(const std::string& path, std::size_t takes);

/// The reports that a run writes: each --report FILE, of which every FILE.html is a page and every
/// other JSON.
struct ReportFiles {
  std::vector<std::string> paths;

  bool empty() const { return paths.empty(); }
  bool with_page() const;
  bool with_json() const;
  /// Whether one of them goes to standard output.
  bool on_out() const;
  /// Adds them to the outputs of a run.
  void add_to(RunFiles& files) const;
  /// Errors: `ErrorKind::cannot_write` for one that exists.
  void check_free(bool force) const;
  void write(std::string_view document, std::string_view page, bool force) const;
};
/// Of a command with `reports_flag`, checked by `check_page`.
ReportFiles report_files(const Arguments& arguments, std::size_t takes);

/// How the program was called, quoted as a shell needs it.
std::string command_line_of(const Arguments& arguments);
PageSettings page_settings(const Arguments& arguments);

/// --report FILE, once.
Flag report_flag(std::string help, std::string details = {});
/// --report FILE, as many times as there are reports to write; `details` without a word on pages.
Flag reports_flag(std::string help, const std::string& details = {});

}  // namespace kinemend::cli
