// Reads a file, cleans its takes, reports, and writes it; converts errors to an outcome.
#include "clean_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "fit_format.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

void refuse_warnings(const std::string& name, const std::vector<std::string>& warnings) {
  if (warnings.empty()) return;
  throw Error(ErrorKind::quality_limit,
              fmt::format("{}: {} (an error under --strict)", name, warnings.front()));
}

// Returns the flags of the command line that have no effect on a take of this kind, one line each.
std::vector<std::string> meaningless_flags(const Take& take, const CleanPlan& plan) {
  const auto is_given = [&](std::string_view flag) {
    return std::find(plan.asked.begin(), plan.asked.end(), flag) != plan.asked.end();
  };
  std::vector<std::string> lines;
  if (!take.has_joints()) {
    if (is_given("max_change_deg"))
      lines.emplace_back("--max-change-deg has no effect on markers; --max-change limits them");
    if (is_given("root_position"))
      lines.emplace_back("--root-position has no effect on markers, which have no root");
    return lines;
  }
  if (is_given("max_change"))
    lines.emplace_back("--max-change has no effect on joints; --max-change-deg limits them");
  if (is_given("fix_swaps"))
    lines.emplace_back("--fix-swaps has no effect on joints; only marker labels can be swapped");
  if (is_given("unlabelled")) lines.emplace_back("--unlabelled has no effect on joints");
  const bool has_gaps = plan.gaps || !take.observed.empty() || !take.observed_positions.empty();
  if (!has_gaps && (is_given("fill") || is_given("fill_all"))) {
    lines.push_back(
        fmt::format("--{} has no effect: the take states no gaps; --gaps FILE lists them",
                    is_given("fill") ? "fill" : "fill-all"));
  }
  return lines;
}

// Returns whether the result is reported anywhere.
bool is_reported(const CleanPlan& plan) {
  return !plan.quiet || plan.json || !plan.reports.empty() || plan.page;
}

CleanSettings settings_for(const Take& take, const CleanPlan& plan, const TakeProgress& progress) {
  CleanSettings settings = plan.settings;
  settings.progress = progress;
  if (!is_reported(plan)) settings.leftovers = Leftovers::none;
  if (plan.gaps)
    settings.gaps = parse_gaps(plan.gaps->first, plan.gaps->second, first_frame_number(take));
  if (plan.range)
    settings.range =
        frames_of(*plan.range, take.frame_count(), take.frame_rate_hz, first_frame_number(take));
  if (plan.contacts && take.has_joints())
    settings.feet->contacts =
        parse_contacts(plan.contacts->first, plan.contacts->second, take, settings.feet->names);
  return settings;
}

// Calls `work(tell)` as a separate progress stage.
template <class Work>
auto as_stage(const TakeProgress& progress, std::string_view name, const Work& work) {
  const auto tell = [&](double done) {
    if (progress) progress(name, done);
  };
  tell(0);
  return work(tell);
}

// Adds the report of one take as text; a file may hold several takes.
void tell(const Report& report, const TakeJob& job, const CleanPlan& plan, Outcome& outcome) {
  TextOptions options;
  options.details = plan.takes.jobs.size() == 1 || plan.verbose;
  options.all = plan.verbose;
  options.colours = Colours::of_out().on();
  const auto add = [](std::string& entries, const std::string& entry) {
    entries += (entries.empty() ? "" : ",\n") + entry;
  };
  if (!plan.quiet) outcome.text += to_text(report, options);
  if (plan.json) add(outcome.json, to_json(report, false));
  if (plan.reports.with_json()) add(outcome.report, to_json(report));
  if (!job.row_name.empty()) outcome.row = cleaned_row(job.row_name, report, outcome.warnings);
}

// Draws a few poses for the index of a batch.
std::string picture_of(const Take& take) {
  constexpr std::size_t poses = 5;
  if (take.frame_count() == 0) return "";
  return film_strip_svg(take, nullptr, {0, take.frame_count() - 1}, poses);
}

// Returns the format of the result. Errors: `ErrorKind::usage` for a format that cannot hold it.
std::string format_of_result(const TakeJob& job, const CleanPlan& plan, const Take& take) {
  const std::string name = input_name(job.input);
  if (plan.to != nullptr) {
    check_can_fit(take, *plan.to);
    return std::string(plan.to->name);
  }
  std::string format = format_for(job.output, take.source);
  check_can_hold(name, take, format);
  return format;
}

// Adds lines about the take to the outcome, or throws the first under --strict.
void warn(const std::vector<std::string>& lines, const TakeJob& job, const CleanPlan& plan,
          Outcome& outcome) {
  const std::string name = input_name(job.input);
  if (plan.strict) refuse_warnings(name, lines);
  for (const std::string& line : lines)
    outcome.warnings.push_back(fmt::format("{}: {}", name, line));
}

// Cleans a take in place and reports on it. Returns the format to write.
std::string clean_and_report(TakeResult& read, const TakeJob& job, const CleanPlan& plan,
                             const TakeProgress& progress, Outcome& outcome) {
  for (const Diagnostic& entry : read.diagnostics.entries())
    outcome.warnings.push_back(diagnostic_line(read.take.source, entry));
  std::string format = format_of_result(job, plan, read.take);
  warn(meaningless_flags(read.take, plan), job, plan, outcome);
  // Cleaning consumes the take, so a page needs a copy.
  std::optional<Take> before;
  if (plan.page) before = read.take;
  if (plan.on_read) plan.on_read(read.take);
  const CleanSettings settings = settings_for(read.take, plan, progress);
  auto [cleaned, done] = clean_take(std::move(read.take), *plan.cleaner, settings);
  read.take = std::move(cleaned);
  if (!plan.preset_note.empty()) done.notes.push_back(plan.preset_note);
  warn(done.warnings, job, plan, outcome);
  std::optional<Take> converted;
  if (plan.to != nullptr) converted = fitted(read.take, *plan.to, {}, outcome.notes);
  for (std::string& line :
       loss_lines(input_name(job.input), converted ? *converted : read.take, format, plan.strict))
    outcome.warnings.push_back(std::move(line));
  Report report{facts_of(read.take, job.input, std::move(read.diagnostics)), std::move(done)};
  if (!plan.dry_run) report.take.output = job.output;
  tell(report, job, plan, outcome);
  if (plan.page) outcome.page = report_page(report, *before, &read.take, *plan.page);
  if (plan.page && !job.row_name.empty()) outcome.picture = picture_of(read.take);
  if (converted) read.take = std::move(*converted);
  return format;
}

// The other takes of the file, which are still to be cleaned.
std::vector<std::string> other_takes(const SourceInfo& source, const CleanPlan& plan) {
  std::vector<std::string> names;
  if (!plan.all_takes) return names;
  names = source.animations;
  std::erase(names, source.animation);
  return names;
}

void check_keeps_format(const TakeJob& job, const SourceInfo& source) {
  if (format_for(job.output, source) == source.format) return;
  throw Error(ErrorKind::usage, fmt::format("{}: --all-takes writes the format of the input, {}",
                                            input_name(job.input), source.format));
}

}  // namespace

Outcome clean_file(const TakeJob& job, const CleanPlan& plan, const TakeProgress& progress) {
  // The library's errors about settings do not name the take.
  Outcome outcome = outcome_of(job.input, true, [&](Outcome& result) {
    refuse_folder(job.input, "clean", "");
    if (!plan.dry_run) check_result(job, plan.takes, plan.force);
    ReadOptions options = plan.reading;
    TakeResult read = as_stage(progress, "reading", [&](const auto& tell) {
      if (progress) options.progress = tell;
      return read_take(fs::path(job.input), options);
    });
    options.progress = {};
    const std::vector<std::string> others = other_takes(read.take.source, plan);
    if (!others.empty()) check_keeps_format(job, read.take.source);
    const std::string format = clean_and_report(read, job, plan, progress, result);
    for (const std::string& other : others) {
      options.animation = other;
      read = read_take(write_take(read.take, format), read.take.source.name, options);
      clean_and_report(read, job, plan, progress, result);
    }
    if (plan.dry_run) return;
    as_stage(progress, "writing",
             [&](const auto&) { write_result(job, plan.takes, read.take, format, plan.force); });
  });
  if (outcome.code != 0 && !job.row_name.empty())
    outcome.row =
        failed_row(job.row_name, job.input, outcome.error, outcome.code, outcome.warnings);
  return outcome;
}

}  // namespace kinemend::cli
