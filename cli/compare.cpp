// kinemend compare: prints every error figure of two takes and checks limits on them.

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "kinemend/metrics.hpp"
#include "kinemend/report.hpp"
#include "page_report.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

ComparisonSettings comparison_settings(const Arguments& arguments, const Take& reference) {
  ComparisonSettings settings;
  settings.first_frame = leading_calibration_frames(reference);
  if (arguments.given("psnr_peak")) settings.psnr_peak = arguments.number("psnr_peak");
  if (arguments.given("metres_per_unit"))
    settings.metres_per_unit = arguments.number("metres_per_unit");
  settings.foot_slide.up = axis_named(arguments.text("up"));
  return settings;
}

TakeFacts take_of(const TakeResult& read, const std::string& name) {
  TakeFacts facts = take_facts(read.take);
  facts.input = name;
  facts.diagnostics = read.diagnostics;
  return facts;
}

MarkerFit fit_of(const std::string& name) {
  if (name == "rigid") return MarkerFit::rigid;
  return name == "gain-offset" ? MarkerFit::gain_offset : MarkerFit::none;
}

const Take& markers_of(const TakeResult& read, const std::string& name) {
  if (!read.take.has_joints()) return read.take;
  throw Error(ErrorKind::usage,
              fmt::format("{}: holds joints, and the other take markers; kinemend "
                          "convert turns joints into markers",
                          name));
}

// Compares as markers if either take holds markers.
CompareOutcome compare_as_markers(const TakeResult& reference, const TakeResult& other,
                                  const Arguments& arguments) {
  CompareOutcome outcome;
  outcome.reference = arguments.positionals[0];
  outcome.fit = fit_of(arguments.text("fit"));
  MarkerComparisonSettings settings;
  settings.fit = outcome.fit;
  settings.lag_frames = arguments.whole("lag");
  settings.least_motion = arguments.number("least_motion");
  std::optional<TakeResult> fit_to;
  if (const std::string name = arguments.text("fit_to"); !name.empty()) {
    fit_to = read_and_warn(name, read_options(arguments));
    settings.fit_to = &markers_of(*fit_to, name);
  }
  outcome.markers = compare_markers(markers_of(reference, outcome.reference),
                                    markers_of(other, arguments.positionals[1]), settings);
  return outcome;
}

CompareOutcome compare_takes(const TakeResult& reference, const TakeResult& other,
                             const Arguments& arguments) {
  if (!reference.take.has_joints() || !other.take.has_joints())
    return compare_as_markers(reference, other, arguments);
  for (const char* flag : {"fit", "fit_to", "lag", "least_motion"}) {
    if (arguments.given(flag))
      throw Error(ErrorKind::usage, fmt::format("--{} is for takes of markers", dashed(flag)));
  }
  CompareOutcome outcome;
  outcome.reference = arguments.positionals[0];
  outcome.comparison =
      compare_clips(reference.take, other.take, comparison_settings(arguments, reference.take));
  return outcome;
}

// The markers of these names, in their order.
Take with_markers(const Take& clip, const std::vector<std::string>& names) {
  Take result;
  result.names = names;
  result.frame_rate_hz = clip.frame_rate_hz;
  result.first_frame = clip.first_frame;
  result.unit = clip.unit;
  std::vector<std::size_t> markers;
  markers.reserve(names.size());
  for (const std::string& name : names)
    markers.push_back(static_cast<std::size_t>(clip.find(name)));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (const std::size_t marker : markers) {
      const std::size_t sample = f * clip.marker_count() + marker;
      result.positions.push_back(clip.positions[sample]);
      result.observed.push_back(clip.observed[sample]);
    }
  }
  return result;
}

struct Compared {
  TakeResult reference, other;
  Report report;
};

Compared compared(const Arguments& arguments) {
  const std::string other_name = arguments.positionals[1];
  TakeResult reference = read_and_warn(arguments.positionals[0], read_options(arguments));
  TakeResult other = read_and_warn(other_name, read_options(arguments));
  CompareOutcome outcome = compare_takes(reference, other, arguments);
  // Names are spelled as in the reference, and lengths are in its unit.
  const TakeFacts shown = take_of(reference, arguments.positionals[0]);
  TakeFacts facts = take_of(other, other_name);
  facts.tracks = outcome.markers ? outcome.markers->names : shown.tracks;
  if (!shown.unit.empty()) facts.unit = shown.unit;
  return {std::move(reference), std::move(other), {std::move(facts), std::move(outcome)}};
}

std::string comparison_page(const Compared& both, PageSettings settings) {
  const auto& [reference, other, report] = both;
  settings.before_label = "reference";
  settings.after_label = "other";
  const auto& markers = std::get<CompareOutcome>(report.result).markers;
  if (!markers) return report_page(report, reference.take, &other.take, settings);
  const Take shown = with_markers(other.take, markers->names);
  return report_page(report, with_markers(reference.take, markers->names), &shown, settings);
}

int run_compare(const Arguments& arguments) {
  const std::string reference_name = arguments.positionals[0];
  const std::string other_name = arguments.positionals[1];
  const ReportFiles reports = report_files(arguments, 1);
  const bool json = arguments.flag("json"), force = arguments.flag("force");
  RunFiles files;
  files.reads("REFERENCE", reference_name)
      .reads("OTHER", other_name)
      .reads("--fit-to", arguments.text("fit_to"))
      .reads("--asf", arguments.text("asf"));
  reports.add_to(files);
  files.check(json);
  reports.check_free(force);
  const Compared both = compared(arguments);
  const Report& report = both.report;
  const std::vector<std::string> takes = {to_json(report)};
  const std::string document = report_document("compare", takes);
  reports.write(
      document,
      reports.with_page() ? comparison_page(both, page_settings(arguments)) : std::string(), force);
  if (json) {
    write_out(document);
  } else if (!reports.on_out() && !arguments.flag("quiet")) {
    TextOptions options;
    options.all = arguments.flag("verbose");
    write_out(to_text(report, options));
  }
  return say_passed_limits(report, comparison_figures(), arguments);
}

Flag list_every_flag() {
  Flag flag = verbose_flag("also list every joint or marker");
  flag.older_names = {"per_joint"};
  return flag;
}

std::vector<Flag> compare_flags() {
  Flag fit = choice_flag(
      "fit", "Markers", "bring REFERENCE to OTHER first", {"none", "rigid", "gain-offset"}, "none",
      "rigid: one turn and one shift of the whole take; gain-offset: a gain and "
      "an offset of each channel, which calibration would mend and which are no noise.");
  Flag fit_to = file_flag("fit_to", "TAKE", "Markers",
                          "fit to this take instead of OTHER, usually the uncleaned one",
                          "A fit to each of several cleaned takes flatters the one that stands "
                          "still.");
  std::vector<Flag> list = {
      json_flag("print JSON instead of text"),
      list_every_flag(),
      quiet_flag("Limits that are exceeded are errors."),
      fit,
      fit_to,
      whole_flag("lag", 0, -1e6, 1e6, "Markers", "frames by which OTHER is behind REFERENCE",
                 "The measured lag is printed as lag_s and not applied."),
      number_flag("least_motion", "", 0, 0, 1e12, "Markers",
                  "ignore channels of REFERENCE that move by less, in file units",
                  "Standard deviation over the take. Distances use all channels."),
      reports_flag("also write the figures: FILE.json, or FILE.html as a page for a browser",
                   "The page shows both takes."),
      force_flag(),
      without_default(number_flag("metres_per_unit", "m", 0, 1e-9, 1e6, "Figures",
                                  "length of a file unit; default: from the height of the "
                                  "skeleton")),
      without_default(number_flag("psnr_peak", "rad", 0, 1e-9, 1e6, "Figures",
                                  "peak of psnr_db (default pi / 2)")),
      choice_flag("up", "Figures", "vertical axis, for foot_slide (default y)", {"x", "y", "z"})};
  append(list, reading_flags());
  for (const FigureRule& entry : comparison_figures()) {
    // The unit already implies the range.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Flag limit = without_default(number_flag(
        std::string(entry.limit), std::string(entry.unit), 0, -infinity, infinity, "Limits",
        fmt::format("exit code 1 where {} is {}", entry.name,
                    entry.more_is_better ? "below this" : "above this")));
    list.push_back(limit);
  }
  return list;
}

}  // namespace

std::string comparison_page(const Arguments& arguments, bool is_served) {
  PageSettings settings = page_settings(arguments);
  settings.is_served = is_served;
  return comparison_page(compared(arguments), std::move(settings));
}

Command compare_command() {
  Command command;
  command.name = "compare";
  command.summary = "print every error figure of a take against its reference";
  command.description =
      "Both takes have the same frames, and the same joints or markers of the same names. A "
      "calibration pose at the start of a reference of joints is left out. Each --max and --min "
      "option sets a limit; where a figure passes one, the exit "
      "code is 1.";
  command.positionals = {{"REFERENCE", "the take to compare with; - is standard input", 1, 1, {}},
                         {"OTHER", "the take to judge", 1, 1, {}}};
  command.flags = compare_flags();
  command.examples = {{"kinemend compare truth.bvh cleaned.bvh", "all figures"},
                      {"kinemend compare truth.bvh cleaned.bvh --max-geodesic-rms-deg 1.2",
                       "as a check in a script"},
                      {"kinemend compare optical.c3d video.trc --fit gain-offset --verbose",
                       "one motion seen by two systems: error by frequency, velocity, lag"}};
  command.run = run_compare;
  return command;
}

}  // namespace kinemend::cli
