// Loads gaps, plan and models, fills the take in place, and reports filled and refused gaps.
#include "fill_take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/take.hpp"
#include "page_report.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

void mark_given_gaps(Take& take, const FillRun& run) {
  if (!run.gaps) return;
  const auto& [text, name] = *run.gaps;
  const std::vector<NamedGap> gaps = parse_gaps(text, name, first_frame_number(take));
  try {
    mark_gaps(take, gaps);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", run.gaps->second, error.what()));
  }
}

FillSettings settings_of(const Arguments& arguments) {
  FillSettings settings;
  settings.method = arguments.text("method");
  settings.names = joints_of(arguments);
  settings.donor = arguments.text("donor");
  settings.longest_gap_s = arguments.given("longest_gap") ? arguments.number("longest_gap") : 0;
  settings.fill_all = arguments.flag("fill_all");
  settings.unlabelled = arguments.flag("unlabelled");
  if (arguments.given("max_error_deg")) settings.max_error_deg = arguments.number("max_error_deg");
  return settings;
}

/// Fills with the shipped network, which is loaded when a gap first needs it.
LearnedFilling fill_by_shipped(const Take& clip) {
  static const LearnedFill fill = make_learned_fill();
  return fill(clip);
}

/// The models of the requested method, or those that a plan's rows and --preview need; there a
/// named model is one for `recurrent`.
FillModels models_of(const Arguments& arguments) {
  const std::string model = arguments.text("model"), map = arguments.text("map");
  const std::string method = arguments.text("method");
  if (method == "learned") return {{}, make_learned_fill({model, map})};
  const bool takes_any = arguments.given("plan") || arguments.flag("preview");
  FillModels models;
  if (takes_any) models.learned = fill_by_shipped;
  if (model.empty()) {
    if (!map.empty()) throw Error(ErrorKind::usage, "fill: --map needs --model");
    return models;
  }
  if (!takes_any && method != "recurrent")
    throw Error(
        ErrorKind::usage,
        "fill: --model is used by --method recurrent and learned, --plan and --preview only");
  models.recurrent = make_recurrent_fill({model, map});
  return models;
}

/// A plan already states these options for each gap.
void check_plan_alone(const Arguments& arguments) {
  if (!arguments.given("plan")) return;
  for (const char* name : {"method", "joints", "markers", "range", "donor", "longest_gap",
                           "fill_all", "max_error_mm", "max_error_deg", "unlabelled"}) {
    if (!arguments.given(name)) continue;
    throw Error(
        ErrorKind::usage,
        fmt::format("fill: --{} cannot be combined with --plan, which says how each gap is filled",
                    dashed(name)));
  }
}

bool is_json(const std::string& path) { return std::filesystem::path(path).extension() == ".json"; }

/// Converts --max-error-mm to the unit of the file.
double max_error_in_file_units(const Take& clip, const FillRun& run) {
  constexpr double metres_per_mm = 0.001;
  const double metres = likely_metres_per_unit(clip);
  if (metres > 0) return *run.max_error_mm * metres_per_mm / metres;
  throw Error(ErrorKind::usage,
              fmt::format("{}: the unit of its lengths is not known, so that --max-error-mm cannot "
                          "be applied; kinemend convert --unit states it",
                          clip.source.name));
}

/// Names flags that have no effect on this kind of take.
std::vector<std::string> meaningless_flags(const Take& take, const FillRun& run) {
  const bool markers = !take.has_joints();
  if (markers && run.settings.max_error_deg > 0)
    return {"--max-error-deg has no effect on markers; --max-error-mm limits their error"};
  if (!markers && run.settings.unlabelled)
    return {"--unlabelled has no effect on a take of joints"};
  return {};
}

/// Fills the gaps of the clip in place.
PlannedFill fill_as_asked(Take& clip, const FillSettings& settings, const FillRun& run,
                          const FillCheck& check) {
  if (!run.plan) return fill_with_plan(clip, settings, check);
  const auto plan = parse_plan(run.plan->first, run.plan->second, clip);
  return fill_with_plan(clip, plan, check, settings.models);
}

/// Fills the take and sets `plan_text` for --plan-out.
FillOutcome fill_in_place(Take& take, const FillRun& run, const FillCheck& check,
                          std::string& plan_text) {
  FillSettings settings = run.settings;
  if (run.range)
    settings.range =
        frames_of(*run.range, take.frame_count(), take.frame_rate_hz, first_frame_number(take));
  if (run.max_error_mm) settings.max_error = max_error_in_file_units(take, run);
  std::optional<Take> before;
  if (run.preview) before = take;
  PlannedFill filled = fill_as_asked(take, settings, run, check);
  FillOutcome outcome{std::move(filled.report)};
  if (before) preview_methods(*before, filled.plan, check, settings.models);
  if (!run.plan_out_path.empty()) {
    plan_text =
        is_json(run.plan_out_path) ? plan_json(take, filled.plan) : plan_csv(take, filled.plan);
  }
  if (run.range) {
    // The remaining gaps, neither filled nor refused, lie outside the range.
    const std::size_t left = find_gaps(take).size() + find_position_gaps(take).size();
    const std::size_t told = outcome.report.refused() + outcome.report.unlabelled;
    outcome.not_within_range = left - std::min(left, told);
  }
  return outcome;
}

}  // namespace

FillRun fill_run_of(const Arguments& arguments) {
  FillRun run;
  run.takes = plan_take_jobs(arguments, arguments.positionals, {"filled"});
  if (run.takes.folder.empty()) check_take_ending(arguments.text("output"));
  const std::vector<TakeJob>& jobs = run.takes.jobs;
  const std::string gap_file = arguments.text("gaps"), plan_file = arguments.text("plan");
  run.reports = report_files(arguments, jobs.size());
  check_plan_alone(arguments);
  run.plan_out_path = arguments.text("plan_out");
  if (jobs.size() > 1 && (!plan_file.empty() || !run.plan_out_path.empty()))
    throw Error(ErrorKind::usage,
                "fill: --plan and --plan-out are for one take; fill several one by one");
  run.preview = arguments.flag("preview");
  if (run.preview && run.plan_out_path.empty())
    throw Error(ErrorKind::usage, "fill: --preview needs --plan-out FILE");
  if (const std::string range = arguments.text("range"); !range.empty())
    run.range = parse_range(range);
  run.settings = settings_of(arguments);
  run.settings.models = models_of(arguments);
  if (arguments.given("max_error_mm")) run.max_error_mm = arguments.number("max_error_mm");
  const bool has_limit = run.max_error_mm || run.settings.max_error_deg > 0;
  if (has_limit && run.settings.fill_all)
    throw Error(ErrorKind::usage,
                "fill: --fill-all fills every gap, so that --max-error-mm and --max-error-deg "
                "cannot be combined with it");
  run.reading = read_options(arguments);
  run.json = arguments.flag("json");
  run.force = arguments.flag("force");
  run.dry_run = arguments.flag("dry_run");
  run.strict = arguments.flag("strict");
  run.quiet = arguments.flag("quiet");
  run.verbose = arguments.flag("verbose");
  run.threads = static_cast<int>(arguments.whole("jobs"));
  RunFiles files;
  for (const char* flag : {"gaps", "plan", "model", "map", "asf"})
    files.reads(fmt::format("--{}", flag), arguments.text(flag));
  for (const TakeJob& job : jobs) {
    files.reads("TAKE", job.input);
    if (run.dry_run)
      files.would_write(result_option(run.takes), job.output);
    else
      files.writes(result_option(run.takes), job.output, job.input);
  }
  files.writes("--plan-out", run.plan_out_path);
  run.reports.add_to(files);
  files.check(run.json);
  if (!run.plan_out_path.empty()) check_free(run.plan_out_path, run.force);
  run.reports.check_free(run.force);
  if (!gap_file.empty()) run.gaps.emplace(read_file(gap_file), input_name(gap_file));
  if (!plan_file.empty()) run.plan.emplace(read_file(plan_file), input_name(plan_file));
  return run;
}

FilledTake fill_take(const FillRun& run, const TakeJob& job, bool with_before,
                     const FillCheck& check) {
  TakeResult read = read_take(std::filesystem::path(job.input), run.reading);
  FilledTake filled;
  for (const Diagnostic& entry : read.diagnostics.entries())
    filled.warnings.push_back(diagnostic_line(read.take.source, entry));
  check_can_hold(input_name(job.input), read.take, format_for(job.output, read.take.source));
  for (const std::string& line : meaningless_flags(read.take, run)) {
    const std::string warning = fmt::format("{}: {}", input_name(job.input), line);
    if (run.strict) throw Error(ErrorKind::quality_limit, warning + " (an error under --strict)");
    filled.warnings.push_back(warning);
  }
  mark_given_gaps(read.take, run);
  if (with_before) filled.before = read.take;
  FillOutcome outcome = fill_in_place(read.take, run, check, filled.plan_text);
  for (const std::string& warning : outcome.report.warnings)
    filled.warnings.push_back(fmt::format("{}: {}", input_name(job.input), warning));
  filled.report = {facts_of(read.take, job.input, std::move(read.diagnostics)), std::move(outcome)};
  filled.after = std::move(read.take);
  return filled;
}

GapCurves gap_curves(const FillRun& run, std::size_t row, const FillCheck& check) {
  if (!run.plan) throw Error(ErrorKind::usage, "fill: there is no plan");
  TakeResult read = read_take(std::filesystem::path(run.takes.jobs.front().input), run.reading);
  mark_given_gaps(read.take, run);
  const auto plan = parse_plan(run.plan->first, run.plan->second, read.take);
  return preview_curves(read.take, plan, row, check, run.settings.models);
}

}  // namespace kinemend::cli
