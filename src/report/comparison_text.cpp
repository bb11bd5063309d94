// Writes the differences of two takes as text.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "kinemend/experimental/text.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

std::string exact(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.4g}", value);
}

std::string figures_text(const TakeFacts& take, const CompareOutcome& outcome) {
  Table table({Align::left, Align::right, Align::left, Align::left});
  for_each_figure(outcome, [&](const FigureRule& rule, const std::optional<double>& value) {
    table.add({std::string(rule.name), value ? exact(*value) : "-",
               value ? unit_of(rule, take) : "", std::string(rule.label)});
  });
  return table.text();
}

std::string joints_text(const TakeFacts& take, const Comparison& comparison) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right});
  table.add({"joint", "rms deg", "max deg", "peak deg/s reference", "other"});
  for (std::size_t j = 0; j < comparison.joints.size(); ++j) {
    const JointComparison& joint = comparison.joints[j];
    table.add({printable_name(take.tracks[j]), figure(joint.geodesic_rms_deg),
               figure(joint.geodesic_max_deg), figure(joint.peak_speed_reference_deg_s),
               figure(joint.peak_speed_other_deg_s)});
  }
  return table.text();
}

std::string markers_text(const TakeFacts& take, const MarkerComparison& comparison) {
  const std::string unit = take.unit.empty() ? "units" : take.unit;
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"marker", "samples", "rms distance " + unit, "max", "velocity rms " + unit + "/s",
             "above 6 Hz " + unit});
  for (std::size_t m = 0; m < comparison.markers.size(); ++m) {
    const MarkerErrors& row = comparison.markers[m];
    table.add({printable_name(comparison.names[m]), grouped(row.samples), figure(row.rms_distance),
               figure(row.max_distance), figure(row.velocity_rms),
               row.above_6_hz ? figure(*row.above_6_hz) : "-"});
  }
  return table.text();
}

// Describes the compared frames and markers.
std::string pairing_text(const CompareOutcome& outcome) {
  const MarkerComparison& comparison = *outcome.markers;
  std::string text = fmt::format("  {} and {} compared", counted(comparison.frames, "frame"),
                                 counted(comparison.names.size(), "marker"));
  if (outcome.fit == MarkerFit::rigid) text += ", the reference fitted by one turn and one shift";
  if (outcome.fit == MarkerFit::gain_offset) text += ", each channel with its own gain and offset";
  if (!comparison.unmatched.empty())
    text += fmt::format("; unmatched: {}", fmt::join(comparison.unmatched, ", "));
  return text;
}

}  // namespace

std::string comparison_text(const TakeFacts& take, const CompareOutcome& outcome,
                            const TextOptions& options) {
  const std::string compared =
      outcome.markers ? pairing_text(outcome)
                      : fmt::format("  {} compared", counted(outcome.comparison.frames, "frame"));
  std::string text = compared + "\n\n" + figures_text(take, outcome);
  if (!options.all) return text;
  return text + "\n" +
         (outcome.markers ? markers_text(take, *outcome.markers)
                          : joints_text(take, outcome.comparison));
}

}  // namespace kinemend
