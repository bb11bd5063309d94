// Defines the tables of all figures, with their units and the functions that read them, counts the
// changes of a cleaning, and finds the limits that figures exceed.
#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "report/texts.hpp"

namespace kinemend {

namespace {

using Value = std::optional<double>;

// Returns none if no foot has contact.
Value slide_of(const FootSlide& slide) {
  return slide.contact_steps > 0 ? Value(slide.per_frame) : std::nullopt;
}

Value count_of(const std::optional<std::size_t>& count) {
  return count ? Value(static_cast<double>(*count)) : std::nullopt;
}

template <class Figures>
std::vector<FigureRule> rules_of(const Figures& figures) {
  std::vector<FigureRule> rules;
  std::transform(figures.begin(), figures.end(), std::back_inserter(rules),
                 [](const auto& figure) { return figure.rule; });
  return rules;
}

}  // namespace

std::span<const CheckFigure> check_figure_table() {
  static constexpr auto table = std::to_array<CheckFigure>(
      {{{"gaps", "gaps", "", "max_gaps", true},
        {FindingKind::gap, FindingKind::gap},
        [](const CheckFigures& f) -> Value { return static_cast<double>(f.gaps); }},
       {{"longest_gap_s", "longest gap", "s", "max_gap_s"},
        {FindingKind::gap, FindingKind::gap},
        [](const CheckFigures& f) -> Value { return f.longest_gap_s; }},
       {{"missing_percent", "samples missing", "%", "max_missing"},
        {FindingKind::gap, FindingKind::gap},
        [](const CheckFigures& f) -> Value { return f.missing_percent; }},
       {{"swaps", "swapped markers", "", "max_swaps", true},
        {FindingKind::swap, FindingKind::swap},
        [](const CheckFigures& f) -> Value { return static_cast<double>(f.swaps); }},
       {{"spikes", "spikes", "", "max_spikes", true},
        {FindingKind::spike, FindingKind::spike},
        [](const CheckFigures& f) -> Value { return static_cast<double>(f.spikes); }},
       {{"frozen", "frozen or bridged spans", "", "max_frozen", true},
        {FindingKind::frozen, FindingKind::bridged},
        [](const CheckFigures& f) -> Value { return static_cast<double>(f.frozen); }},
       {{"worst_noise", "noise of the worst track", "", "max_noise"},
        {FindingKind::noise, FindingKind::noise},
        [](const CheckFigures& f) -> Value { return f.worst_noise; }},
       {{"length_change_percent", "change of a length", "%", "max_length_change"},
        {FindingKind::length, FindingKind::length},
        [](const CheckFigures& f) -> Value { return f.length_change_percent; }},
       {{"slide_cm", "slide of a standing foot", "cm", "max_slide_cm"},
        {FindingKind::slide, FindingKind::slide},
        [](const CheckFigures& f) -> Value { return f.slide_cm; }},
       {{"sink_cm", "depth below the floor", "cm", "max_sink_cm"},
        {FindingKind::sink, FindingKind::sink},
        [](const CheckFigures& f) -> Value { return f.sink_cm; }},
       {{"flips", "Euler flips", "", "max_flips", true},
        {FindingKind::euler_flip, FindingKind::euler_flip},
        [](const CheckFigures& f) -> Value { return static_cast<double>(f.flips); }},
       {{"joint_speed_deg_s", "fastest joint", "deg/s", "max_joint_speed", false, false, true},
        {FindingKind::joint_speed, FindingKind::joint_speed},
        [](const CheckFigures& f) { return f.joint_speed_deg_s; }},
       {{"joint_acceleration_deg_s2", "largest acceleration of a joint", "deg/s2",
         "max_joint_acceleration", false, false, true},
        {FindingKind::joint_acceleration, FindingKind::joint_acceleration},
        [](const CheckFigures& f) { return f.joint_acceleration_deg_s2; }},
       {{"jumps", "jumps", "", "max_jumps", true, false, true},
        {FindingKind::jump, FindingKind::jump},
        [](const CheckFigures& f) { return count_of(f.jumps); }},
       {{"flights", "times in the air", "", "max_flights", true, false, true},
        {FindingKind::floating, FindingKind::flight},
        [](const CheckFigures& f) { return count_of(f.flights); }},
       {{"penetration_cm", "depth below the level of standing", "cm", "max_penetration_cm", false,
         false, true},
        {FindingKind::penetration, FindingKind::penetration},
        [](const CheckFigures& f) { return f.penetration_cm; }},
       {{"floating_cm", "height of a standing foot above the floor", "cm", "max_floating_cm", false,
         false, true},
        {FindingKind::floating, FindingKind::floating},
        [](const CheckFigures& f) { return f.floating_cm; }},
       {{"floor_cm", "distance of the floor from height 0", "cm", "max_floor_cm", false, false,
         true},
        {FindingKind::floor, FindingKind::floor},
        [](const CheckFigures& f) { return f.floor_cm; }}});
  return table;
}

std::string unit_of(const CheckFigure& figure, const CheckReport& report) {
  const bool is_of_tracks = figure.rule.unit.empty() && !figure.rule.is_count;
  return is_of_tracks ? report.noise_unit : std::string(figure.rule.unit);
}

std::span<const ComparisonFigure> comparison_figure_table() {
  static constexpr auto table = std::to_array<ComparisonFigure>(
      {{{"rms_deg", "joint-angle channels, mean over frames (Mall et al.)", "deg", "max_rms_deg"},
        [](const Comparison& c) -> Value { return c.rms_deg; }},
       {{"geodesic_rms_deg", "angle between local rotations, all joints", "deg",
         "max_geodesic_rms_deg"},
        [](const Comparison& c) -> Value { return c.geodesic_rms_deg; }},
       {{"geodesic_p99_deg", "its 99th percentile", "deg", "max_geodesic_p99_deg"},
        [](const Comparison& c) -> Value { return c.geodesic_p99_deg; }},
       {{"geodesic_max_deg", "its largest value", "deg", "max_geodesic_max_deg"},
        [](const Comparison& c) -> Value { return c.geodesic_max_deg; }},
       {{"mpjpe", "mean distance of joint positions, file units", "units", "max_mpjpe"},
        [](const Comparison& c) -> Value { return c.mpjpe; }},
       {{"mpjpe_cm", "the same where the unit is known", "cm", "max_mpjpe_cm"},
        [](const Comparison& c) -> Value { return c.mpjpe_cm; }},
       {{"accel_error", "difference of joint accelerations", "units/s2", "max_accel_error"},
        [](const Comparison& c) -> Value { return c.accel_error; }},
       {{"psnr_db", "peak signal to noise of the logarithms (Dean)", "dB", "min_psnr_db", false,
         true},
        [](const Comparison& c) -> Value { return c.psnr_db; }},
       {{"rmse_per_marker_m", "distance of joint positions per frame, mean (Xiao et al.)", "m",
         "max_rmse_per_marker_m"},
        [](const Comparison& c) -> Value {
          return c.rmse_per_marker_m ? Value(c.rmse_per_marker_m->mean) : std::nullopt;
        }},
       {{"rmse_per_marker_deviation_m", "its standard deviation over frames", "m",
         "max_rmse_per_marker_deviation_m"},
        [](const Comparison& c) -> Value {
          return c.rmse_per_marker_m ? Value(c.rmse_per_marker_m->deviation) : std::nullopt;
        }},
       {{"mse_rad2", "squared angle, mean over joints (Courty)", "rad2", "max_mse_rad2"},
        [](const Comparison& c) -> Value { return c.mse_rad2; }},
       {{"foot_slide", "travel per frame of feet in contact, of OTHER", "units", "max_foot_slide"},
        [](const Comparison& c) { return slide_of(c.foot_slide); }},
       {{"foot_slide_reference", "the same of REFERENCE, for comparison", "units",
         "max_foot_slide_reference"},
        [](const Comparison& c) { return slide_of(c.foot_slide_reference); }}});
  return table;
}

std::span<const MarkerComparisonFigure> marker_comparison_figure_table() {
  using C = MarkerComparison;
  static constexpr auto table = std::to_array<MarkerComparisonFigure>(
      {{{"rms_distance", "distance of positions, root mean square", "", "max_rms_distance"},
        [](const C& c) -> Value { return c.all.rms_distance; }},
       {{"p99_distance", "its 99th percentile", "", "max_p99_distance"},
        [](const C& c) -> Value { return c.p99_distance; }},
       {{"max_distance", "its largest value", "", "max_distance"},
        [](const C& c) -> Value { return c.all.max_distance; }},
       {{"rms_axis", "error along an axis", "", "max_rms_axis"},
        [](const C& c) -> Value { return c.all.rms; }},
       {{"velocity_rms", "error of velocity along an axis", "/s", "max_velocity_rms"},
        [](const C& c) -> Value { return c.all.velocity_rms; }},
       {{"below_2_hz", "error along an axis, below 2 Hz", "", "max_below_2_hz"},
        [](const C& c) { return c.all.bands[0]; }},
       {{"from_2_to_6_hz", "the same, 2 to 6 Hz", "", "max_from_2_to_6_hz"},
        [](const C& c) { return c.all.bands[1]; }},
       {{"from_6_to_15_hz", "the same, 6 to 15 Hz", "", "max_from_6_to_15_hz"},
        [](const C& c) { return c.all.bands[2]; }},
       {{"above_15_hz", "the same, above 15 Hz", "", "max_above_15_hz"},
        [](const C& c) { return c.all.bands[3]; }},
       {{"above_6_hz", "jitter: the same, above 6 Hz", "", "max_above_6_hz"},
        [](const C& c) { return c.all.above_6_hz; }},
       {{"lag_s", "by how much OTHER comes later; not applied", "s", "max_lag_s"},
        [](const C& c) -> Value { return c.lag_s; }}});
  return table;
}

std::string unit_of(const FigureRule& rule, const TakeFacts& take) {
  const bool is_of_markers = take.kind == TakeKind::markers;
  std::string own = take.unit.empty() ? "units" : take.unit;
  if (is_of_markers && rule.unit.empty()) return own;
  return is_of_markers && rule.unit == "/s" ? own + "/s" : std::string(rule.unit);
}

std::span<const FigureRule> check_figures() {
  static const std::vector<FigureRule> rules = rules_of(check_figure_table());
  return rules;
}

std::span<const FigureRule> comparison_figures() {
  static const std::vector<FigureRule> rules = [] {
    std::vector<FigureRule> list = rules_of(comparison_figure_table());
    const std::vector<FigureRule> of_markers = rules_of(marker_comparison_figure_table());
    list.insert(list.end(), of_markers.begin(), of_markers.end());
    return list;
  }();
  return rules;
}

std::string_view to_string(MarkerFit fit) {
  switch (fit) {
    case MarkerFit::none:
      return "none";
    case MarkerFit::rigid:
      return "rigid";
    case MarkerFit::gain_offset:
      return "gain-offset";
  }
  return "unknown";
}

std::size_t count_spans(const CleanReport& report, Action action) {
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(),
                    [&](const ReportSpan& span) { return span.action == action; }));
}

std::size_t count_bursts(const CleanReport& report) {
  // The least length of a burst. Chosen by hand.
  constexpr std::size_t fewest_frames = 3;
  return static_cast<std::size_t>(
      std::count_if(report.spans.begin(), report.spans.end(), [](const ReportSpan& span) {
        return span.action == Action::despiked &&
               span.last_frame - span.first_frame + 1 >= fewest_frames;
      }));
}

std::size_t tracks_counted(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.tracks.begin(), report.tracks.end(),
                    [](const TrackSummary& track) { return track.is_position; }));
}

std::size_t tracks_changed(const CleanReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.tracks.begin(), report.tracks.end(),
                    [](const TrackSummary& track) { return track.frames_changed > 0; }));
}

std::size_t frames_repaired(const CleanReport& report) {
  std::vector<bool> repaired(report.frames, false);
  for (const ReportSpan& span : report.spans) {
    if (span.action != Action::despiked && span.action != Action::filled) continue;
    for (std::size_t f = span.first_frame; f <= span.last_frame && f < repaired.size(); ++f)
      repaired[f] = true;
  }
  return static_cast<std::size_t>(std::count(repaired.begin(), repaired.end(), true));
}

std::size_t gaps_left(const CleanReport& report) {
  std::size_t gaps = 0;
  for (const TrackSummary& track : report.tracks) gaps += track.gaps_left;
  return gaps;
}

double frames_per_second(const CleanReport& report) {
  return report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0;
}

bool is_changed(const CleanReport& report, std::int32_t track) {
  return track < 0 ? report.root_max_change > 0 : report.tracks[track].frames_changed > 0;
}

std::string track_name(const CleanReport& report, std::int32_t track) {
  return track < 0 ? "root position" : report.tracks[track].name;
}

std::size_t frames_adjusted(const FeetReport& report) {
  const std::size_t frames = report.root_changed.size();
  const std::size_t joints = frames > 0 ? report.changed.size() / frames : 0;
  std::size_t adjusted = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const auto row = report.changed.begin() + static_cast<std::ptrdiff_t>(f * joints);
    const auto end = row + static_cast<std::ptrdiff_t>(joints);
    adjusted += report.root_changed[f] != 0 || std::find(row, end, 1) != end ? 1 : 0;
  }
  return adjusted;
}

std::size_t contacts_held(const FeetReport& report) {
  return static_cast<std::size_t>(std::count(report.held.begin(), report.held.end(), 1));
}

namespace {

const FigureLimit* limit_of(std::string_view figure, std::span<const FigureLimit> limits) {
  const auto found = std::find_if(limits.begin(), limits.end(),
                                  [&](const FigureLimit& limit) { return limit.figure == figure; });
  return found == limits.end() ? nullptr : &*found;
}

// Returns a limit's option on the command line: "--max-gap-s".
std::string option_of(const FigureRule& rule) {
  std::string name(rule.limit);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::vector<std::string> passed(const TakeFacts& take, const CheckReport& report,
                                std::span<const FigureLimit> limits) {
  std::vector<std::string> lines;
  for (const CheckFigure& figure : check_figure_table()) {
    const FigureLimit* const limit = limit_of(figure.rule.name, limits);
    const std::optional<double> value = figure.get(report.figures);
    if (limit == nullptr || !value || *value <= limit->value) continue;
    const std::string unit = unit_of(figure, report);
    std::string line = fmt::format(
        "{}: {}: {} is above the limit {}", take.input == "-" ? "standard input" : take.input,
        figure.rule.label, with_unit(*value, unit), with_unit(limit->value, unit));
    const auto worst =
        std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& finding) {
          return std::find(figure.kinds.begin(), figure.kinds.end(), finding.kind) !=
                 figure.kinds.end();
        });
    if (worst != report.findings.end()) line += "; " + finding_sentence(*worst, take, report);
    lines.push_back(std::move(line));
  }
  return lines;
}

// Returns why a figure of a comparison is unknown.
std::string_view unknown_for(const FigureRule& rule, const CompareOutcome& outcome) {
  if (outcome.markers) return "the take is too short, or its rate too low";
  return rule.name.starts_with("foot_slide") ? "no foot has ground contact"
                                             : "the unit of length is unknown";
}

std::vector<std::string> passed(const TakeFacts& /*take*/, const CompareOutcome& outcome,
                                std::span<const FigureLimit> limits) {
  std::vector<std::string> lines;
  std::size_t known = 0;
  for_each_figure(outcome, [&](const FigureRule& rule, const std::optional<double>& value) {
    const FigureLimit* const limit = limit_of(rule.name, limits);
    if (limit == nullptr) return;
    ++known;
    if (!value) {
      lines.push_back(fmt::format("{} is unknown because {}: {} cannot be checked", rule.name,
                                  unknown_for(rule, outcome), option_of(rule)));
    } else if (rule.more_is_better ? !(*value >= limit->value) : !(*value <= limit->value)) {
      lines.push_back(fmt::format("{} {:.4g} is {} the limit {:.4g}", rule.name, *value,
                                  rule.more_is_better ? "below" : "above", limit->value));
    }
  });
  if (known == limits.size()) return lines;
  const std::size_t of_joints = comparison_figure_table().size();
  const std::span<const FigureRule> all = comparison_figures();
  for (const FigureRule& rule : outcome.markers ? all.first(of_joints) : all.subspan(of_joints)) {
    if (limit_of(rule.name, limits) != nullptr)
      lines.push_back(fmt::format("{} is a figure of {}: {} cannot be checked", rule.name,
                                  outcome.markers ? "joints" : "markers", option_of(rule)));
  }
  return lines;
}

template <class Result>
std::vector<std::string> passed(const TakeFacts& /*take*/, const Result& /*result*/,
                                std::span<const FigureLimit> /*limits*/) {
  return {};
}

}  // namespace

std::vector<std::string> passed_limits(const Report& report, std::span<const FigureLimit> limits) {
  return std::visit([&](const auto& result) { return passed(report.take, result, limits); },
                    report.result);
}

}  // namespace kinemend
