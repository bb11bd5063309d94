// Checks whether the unit of a take fits a person.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "check/checks.hpp"

namespace kinemend::check {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t fewest_joints = 10;  // of a body with a meaningful size
constexpr std::size_t fewest_markers = 8;  // of such a body

std::string size_text(double metres) {
  return metres >= 0.1 ? fmt::format("{:.3g} m", metres) : fmt::format("{:.3g} mm", 1000 * metres);
}

// Returns the median over frames of the largest extent along an axis, in file units.
double usual_extent(const Take& clip, const std::vector<std::size_t>& markers) {
  const std::size_t frames = clip.frame_count(), count = std::min(frames, most_looked_at);
  std::vector<double> extents;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t f = i * frames / count;
    std::size_t seen = 0;
    Vec3 low, high;
    for (const std::size_t m : markers) {
      if (!clip.is_observed(f, m)) continue;
      const Vec3 p = clip.position(f, m);
      if (seen++ == 0) low = high = p;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (seen >= fewest_markers)
      extents.push_back(std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
  }
  return median_of(extents);
}

// Returns the unit in which the markers have the extent of a person.
const LengthUnit* unit_of_extent(double extent) {
  static constexpr std::array<LengthUnit, 4> units{
      {{"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}, {"inch", 0.0254}}};
  for (const LengthUnit& unit : units) {
    const double metres = extent * unit.metres;
    if (metres >= 0.7 && metres <= 2.6) return &unit;
  }
  return nullptr;
}

Finding finding_of(Severity severity, double size_m, const CheckReport& report, std::string words) {
  const std::size_t last = std::max<std::size_t>(report.frames, 1) - 1;
  return {FindingKind::unit, severity, "", 0, last, size_m, "m", std::move(words)};
}

}  // namespace

void check_unit(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  const auto guess = guess_length_unit(clip.skeleton);
  const double height = body_height(clip.skeleton);
  const double declared = settings.metres_per_unit.value_or(clip.metres_per_unit);
  report.metres_per_unit = declared > 0 ? declared : guess ? guess->metres : 0;
  if (clip.joint_count() < fewest_joints || !(height > 0)) return;
  if (declared > 0) {
    const double metres = height * declared;
    if (metres >= 0.6 && metres <= 3) return;
    std::string words = fmt::format("the body would be {} tall", size_text(metres));
    if (guess)
      words += fmt::format("; in {} it is {}", guess->name, size_text(height * guess->metres));
    report.findings.push_back(finding_of(Severity::serious, metres, report, std::move(words)));
  } else if (!guess) {
    report.findings.push_back(finding_of(
        Severity::note, 0, report,
        fmt::format(
            "the height of the body is {:.3g}, which no usual unit makes the height of a person",
            height)));
  }
}

void check_unit(const Take& clip, const std::vector<std::size_t>& markers,
                const CheckSettings& settings, CheckReport& report) {
  const double extent = usual_extent(clip, markers);
  const LengthUnit* guess = unit_of_extent(extent);
  const double declared = settings.metres_per_unit.value_or(metres_per_unit(clip.unit));
  report.metres_per_unit = declared > 0 ? declared : guess != nullptr ? guess->metres : 0;
  if (declared > 0) {
    const double metres = extent * declared;
    // An incomplete body, or several people, do not indicate a wrong unit.
    if (extent == 0 || (metres > 0.12 && metres < 12)) return;
    std::string words = fmt::format("the markers would span {}", size_text(metres));
    if (guess != nullptr)
      words += fmt::format("; in {} it is {}", guess->name, size_text(extent * guess->metres));
    report.findings.push_back(finding_of(Severity::serious, metres, report, std::move(words)));
  } else if (!markers.empty()) {
    report.findings.push_back(finding_of(
        Severity::note, 0, report,
        guess != nullptr ? fmt::format("the file states no unit; {} is assumed", guess->name)
                         : std::string("the file states no known unit")));
  }
}

}  // namespace kinemend::check
