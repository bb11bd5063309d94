#include <fmt/format.h>

#include <cmath>

#include "kinemend/text.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

// What `compare` says.
namespace kinemend {

namespace {

std::string exact(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.4g}", value);
}

}  // namespace

std::string comparison_text(const TakeFacts& take, const CompareOutcome& outcome,
                            const TextOptions& options) {
  const Comparison& comparison = outcome.comparison;
  Table table({Align::left, Align::right, Align::left, Align::left});
  for (const ComparisonFigure& entry : comparison_figure_table()) {
    const auto value = entry.get(comparison);
    table.add({std::string(entry.rule.name), value ? exact(*value) : "-",
               std::string(value ? entry.rule.unit : ""), std::string(entry.rule.label)});
  }
  std::string text = fmt::format("  {} compared\n\n", counted(comparison.frames, "frame"));
  text += table.text();
  if (!options.all) return text;
  Table joints({Align::left, Align::right, Align::right, Align::right, Align::right});
  joints.add({"joint", "rms deg", "max deg", "peak deg/s reference", "other"});
  for (std::size_t j = 0; j < comparison.joints.size(); ++j) {
    const JointComparison& joint = comparison.joints[j];
    joints.add({printable(take.tracks[j]), figure(joint.geodesic_rms_deg),
                figure(joint.geodesic_max_deg), figure(joint.peak_speed_reference_deg_s),
                figure(joint.peak_speed_other_deg_s)});
  }
  return text + "\n" + joints.text();
}

}  // namespace kinemend
