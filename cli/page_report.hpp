#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "kinemend/experimental/page.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"

// Reports that are pages for a browser: --report FILE.html.
namespace kinemend::cli {

/// Whether a report of that name is a page and no JSON.
bool is_page(const std::string& path);
/// Refuses a page that this build cannot make, or of several takes, before work is spent on it.
/// JSON is fine. Errors: `ErrorKind::usage`.
void check_page(const std::string& path, std::size_t takes);
/// Refuses a report that would replace what the run reads or writes, also by --force: `others` and,
/// as AMC files find theirs without a word, any skeleton. Errors: `ErrorKind::usage`.
void check_report(const std::string& path, const std::vector<std::string>& others);
/// How the program was called, quoted as a shell needs it.
std::string command_line_of(const Arguments& arguments);
PageSettings page_settings(const Arguments& arguments);
/// `after` is null where there is one take; else of the same kind.
std::string page_of(const Report& report, const Take& before, const Take* after,
                    const PageSettings& settings);

/// --report FILE of the commands that change nothing.
Flag report_flag(std::string help, std::string details = {});

}  // namespace kinemend::cli
