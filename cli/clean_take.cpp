#include "clean_take.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <new>

#include "clean_report.hpp"
#include "kinemend/io.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

void write_result(const CleanJob& job, const Clip& clip, const CleanPlan& plan) {
  const Format* named = job.output == "-" ? nullptr : format_of_path(job.output);
  const std::string_view format = named ? named->name : std::string_view(clip.source.format);
  const std::string bytes = write_clip(clip, format);
  std::error_code error;
  if (!plan.folder.empty()) fs::create_directories(plan.folder, error);
  if (error)
    throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", plan.folder, error.message()));
  write_output(job.output, bytes, plan.force || job.may_replace);
}

void refuse_warnings(const std::string& name, const CleanReport& report) {
  if (report.warnings.empty()) return;
  throw Error(ErrorKind::quality_limit,
              fmt::format("{}: {} (an error under --strict)", name, report.warnings.front()));
}

void clean_take(const CleanJob& job, const CleanPlan& plan, Outcome& outcome) {
  const std::string name = input_name(job.input);
  if (!plan.dry_run) check_free(job.output, plan.force || job.may_replace);
  ReadOptions options;
  options.format = plan.format;
  options.strict = plan.strict;
  ReadResult take = read_clip(fs::path(job.input), options);
  for (const Diagnostic& entry : take.diagnostics.entries())
    outcome.warnings.push_back(diagnostic_line(name, entry));
  CleanSettings settings = plan.settings;
  if (plan.range) settings.range = frames_of(*plan.range, take.clip);
  const CleanResult result = tbb::this_task_arena::isolate(
      [&] { return clean_clip(take.clip, *plan.cleaner, settings, plan.method); });
  if (plan.strict) refuse_warnings(name, result.report);
  for (const std::string& warning : result.report.warnings)
    outcome.warnings.push_back(fmt::format("{}: {}", name, warning));
  if (!plan.dry_run) write_result(job, result.clip, plan);
  const bool is_only = plan.jobs.size() == 1;
  outcome.text = headline(job, result.report, plan, Colours::of_out());
  if (is_only || plan.verbose) outcome.text += report_text(result.report, plan.verbose);
  const auto entry = [&](bool with_spans) {
    return std::make_shared<const Json>(
        report_json(job, result.report, take.diagnostics, plan, with_spans));
  };
  if (plan.json) outcome.json = entry(false);
  if (!plan.report_path.empty()) outcome.report = entry(true);
}

}  // namespace

Outcome try_take(const CleanJob& job, const CleanPlan& plan) {
  Outcome outcome;
  try {
    clean_take(job, plan, outcome);
    return outcome;
  } catch (const Error& error) {
    outcome.code = static_cast<int>(error.kind());
    outcome.error = error.what();
    // What the library says of settings does not name the take.
    if (error.kind() == ErrorKind::usage)
      outcome.error = fmt::format("{}: {}", input_name(job.input), error.what());
  } catch (const std::bad_alloc&) {
    outcome.code = static_cast<int>(ErrorKind::unreadable_input);
    outcome.error = input_name(job.input) + ": out of memory";
  }
  outcome.json = outcome.report = std::make_shared<const Json>(
      Json{{"input", job.input}, {"error", outcome.error}, {"exit_code", outcome.code}});
  return outcome;
}

}  // namespace kinemend::cli
