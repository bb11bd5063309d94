// The reports of a run: each `--report FILE.html` is a page for a browser, and any other is JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "run_files.hpp"

namespace kinemend::cli {

/// Returns whether a report of that name is a page; otherwise it is JSON.
bool is_page(const std::string& path);
/// Refuses a page that this build cannot make, a page of several takes, and a report named like a
/// skeleton (FILE.asf), which an AMC file would read. Call it before the work. Errors:
/// `ErrorKind::usage`.
void check_page(const std::string& path, std::size_t takes);

/// The reports that a run writes, from each --report FILE: every FILE.html is a page, every other
/// one is JSON.
struct ReportFiles {
  std::vector<std::string> paths;

  bool empty() const { return paths.empty(); }
  bool with_page() const;
  bool with_json() const;
  /// Returns whether one of them goes to standard output.
  bool on_out() const;
  /// Adds them to the outputs of a run.
  void add_to(RunFiles& files) const;
  /// Errors: `ErrorKind::cannot_write` for one that exists.
  void check_free(bool force) const;
  void write(std::string_view document, std::string_view page, bool force) const;
};
/// The reports of a command with `reports_flag`; checks them with `check_page`.
ReportFiles report_files(const Arguments& arguments, std::size_t takes);

PageSettings page_settings(const Arguments& arguments);

/// --report FILE, allowed once.
Flag report_flag(std::string help, std::string details = {});
/// --report FILE, allowed several times; `details` must not explain pages.
Flag reports_flag(std::string help, const std::string& details = {});

}  // namespace kinemend::cli
