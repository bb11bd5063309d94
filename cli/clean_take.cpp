// Takes one file through all steps from reading to reports, and converts errors to an outcome.
#include "clean_take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "clean_leftovers.hpp"
#include "fit_format.hpp"
#include "kinemend/check.hpp"
#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/pictures.hpp"
#include "kinemend/experimental/threads.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
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

// Runs the steps before the cleaner: label swaps, then gaps.
std::vector<MarkerSwap> prepare(Take& take, const CleanPlan& plan) {
  std::vector<MarkerSwap> swaps;
  if (!take.has_joints() && plan.fix_swaps) {
    swaps = find_swaps(take);
    undo_swaps(take, swaps);
  }
  if (plan.gaps)
    mark_gaps(take, parse_gaps(plan.gaps->first, plan.gaps->second, first_frame_number(take)));
  return swaps;
}

CleanSettings settings_for(const Take& take, const CleanPlan& plan, const TakeProgress& progress) {
  CleanSettings settings = plan.settings;
  settings.progress = progress;
  if (plan.range)
    settings.range =
        frames_of(*plan.range, take.frame_count(), take.frame_rate_hz, first_frame_number(take));
  if (plan.contacts && take.has_joints())
    settings.feet->contacts =
        parse_contacts(plan.contacts->first, plan.contacts->second, take, settings.feet->names);
  return settings;
}

// Returns whether the result is reported anywhere.
bool is_reported(const CleanPlan& plan) {
  return !plan.quiet || plan.json || !plan.reports.empty() || plan.page;
}

bool is_unchanged(const CleanOutcome& outcome) {
  const CleanReport& report = outcome.report;
  return outcome.swaps.empty() && report.root_max_change == 0 &&
         std::all_of(report.tracks.begin(), report.tracks.end(),
                     [](const TrackSummary& track) { return track.frames_changed == 0; });
}

// Cleans the take in place.
CleanOutcome clean_in_place(Take& take, const std::string& input, const CleanPlan& plan,
                            const TakeProgress& progress) {
  CleanOutcome outcome;
  outcome.options = plan.options;
  outcome.swaps = prepare(take, plan);
  if (is_reported(plan)) outcome.leftovers = leftovers_of(find_beyond_cleaning(take), plan, input);
  const CleanSettings settings = settings_for(take, plan, progress);
  CleanResult result;
  run_isolated([&] { result = clean_take(std::move(take), *plan.cleaner, settings); });
  take = std::move(result.take);
  outcome.report = std::move(result.report);
  if (!plan.preset_note.empty()) outcome.report.notes.push_back(plan.preset_note);
  if (plan.cleans && is_reported(plan) && is_unchanged(outcome)) {
    std::vector<Leftover> reasons = reasons_unchanged(take, outcome.report, plan, input);
    std::move(reasons.begin(), reasons.end(), std::back_inserter(outcome.leftovers));
  }
  return outcome;
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

// Cleans a take in place and reports on it. Returns the format to write.
std::string clean_one(TakeResult& read, const TakeJob& job, const CleanPlan& plan,
                      const TakeProgress& progress, Outcome& outcome) {
  const std::string name = input_name(job.input);
  for (const Diagnostic& entry : read.diagnostics.entries())
    outcome.warnings.push_back(diagnostic_line(read.take.source, entry));
  std::string format =
      plan.to != nullptr ? std::string(plan.to->name) : format_for(job.output, read.take.source);
  if (plan.to == nullptr)
    check_can_hold(name, read.take, format);
  else
    check_can_fit(read.take, *plan.to);
  const std::vector<std::string> meaningless = meaningless_flags(read.take, plan);
  if (plan.strict) refuse_warnings(name, meaningless);
  for (const std::string& line : meaningless)
    outcome.warnings.push_back(fmt::format("{}: {}", name, line));
  // Cleaning consumes the take, so a page needs a copy.
  std::optional<Take> before;
  if (plan.page) before = read.take;
  if (plan.on_read) plan.on_read(read.take);
  CleanOutcome cleaned = clean_in_place(read.take, job.input, plan, progress);
  const std::vector<std::string> warnings = cleaned.report.warnings;
  if (plan.strict) refuse_warnings(name, warnings);
  for (const std::string& warning : warnings)
    outcome.warnings.push_back(fmt::format("{}: {}", name, warning));
  std::optional<Take> converted;
  if (plan.to != nullptr) converted = fitted(read.take, *plan.to, {}, outcome.notes);
  for (std::string& line :
       loss_lines(name, converted ? *converted : read.take, format, plan.strict))
    outcome.warnings.push_back(std::move(line));
  Report report{facts_of(read.take, job.input, std::move(read.diagnostics)), std::move(cleaned)};
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

void clean_job(const TakeJob& job, const CleanPlan& plan, const TakeProgress& progress,
               Outcome& outcome) {
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
  std::string format = clean_one(read, job, plan, progress, outcome);
  for (const std::string& other : others) {
    options.animation = other;
    read = read_take(write_take(read.take, format), read.take.source.name, options);
    clean_one(read, job, plan, progress, outcome);
  }
  if (!plan.dry_run)
    as_stage(progress, "writing",
             [&](const auto&) { write_result(job, plan.takes, read.take, format, plan.force); });
}

}  // namespace

Outcome try_take(const TakeJob& job, const CleanPlan& plan, const TakeProgress& progress) {
  // The library's errors about settings do not name the take.
  Outcome outcome =
      outcome_of(job.input, true, [&](Outcome& result) { clean_job(job, plan, progress, result); });
  if (outcome.code != 0 && !job.row_name.empty())
    outcome.row =
        failed_row(job.row_name, job.input, outcome.error, outcome.code, outcome.warnings);
  return outcome;
}

}  // namespace kinemend::cli
