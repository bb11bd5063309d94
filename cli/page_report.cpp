// Selects pages or JSON by extension, checks them before work begins, and writes them.
#include "page_report.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

std::string lower_extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

}  // namespace

bool is_page(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".html" || extension == ".htm";
}

void check_page(const std::string& path, std::size_t takes) {
  if (lower_extension(path) == ".asf") {
    throw Error(ErrorKind::usage,
                "--report: a file that ends in .asf is the skeleton of takes; reports are "
                "FILE.html or FILE.json");
  }
  if (!is_page(path)) return;
  if (!has_report_page()) {
    throw Error(ErrorKind::usage,
                "--report: this kinemend was built without its report page; use "
                "FILE.json");
  }
  if (takes > 1)
    throw Error(ErrorKind::usage, "--report: a page shows one take; use FILE.json for several");
}

bool ReportFiles::with_page() const { return std::any_of(paths.begin(), paths.end(), is_page); }

bool ReportFiles::with_json() const { return !std::all_of(paths.begin(), paths.end(), is_page); }

bool ReportFiles::on_out() const {
  return std::find(paths.begin(), paths.end(), "-") != paths.end();
}

void ReportFiles::add_to(RunFiles& files) const {
  for (const std::string& path : paths) files.writes("--report", path);
}

void ReportFiles::check_free(bool force) const {
  for (const std::string& path : paths) cli::check_free(path, force);
}

void ReportFiles::write(std::string_view document, std::string_view page, bool force) const {
  for (const std::string& path : paths) write_output(path, is_page(path) ? page : document, force);
}

ReportFiles report_files(const Arguments& arguments, std::size_t takes) {
  ReportFiles files{arguments.list("report")};
  std::erase(files.paths, "");
  for (const std::string& path : files.paths) check_page(path, takes);
  return files;
}

PageSettings page_settings(const Arguments& arguments) {
  PageSettings settings;
  settings.command = arguments.command->name;
  settings.command_line = shell_line(arguments.words);
  return settings;
}

Flag report_flag(std::string help, std::string details) {
  return file_flag("report", "FILE", "Output", std::move(help), std::move(details));
}

Flag reports_flag(std::string help, const std::string& details) {
  Flag flag = report_flag(std::move(help), (details.empty() ? "" : details + " ") +
                                               "Give it twice to write both a page and JSON.");
  flag.takes = Takes::repeated;
  return flag;
}

}  // namespace kinemend::cli
