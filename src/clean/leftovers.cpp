// Describes the findings of a check and the noise of a report, each with its reason and advice.
#include "clean/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "clean/changes.hpp"
#include "kinemend/check.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

constexpr const char* listing = "kinemend check TAKE lists them";

std::size_t count_of(const std::vector<Finding>& findings,
                     std::initializer_list<FindingKind> kinds) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& finding) {
        return std::find(kinds.begin(), kinds.end(), finding.kind) != kinds.end();
      }));
}

}  // namespace

std::vector<Leftover> leftovers_beyond_cleaning(const Take& input, const CleanSettings& settings) {
  if (settings.leftovers == Leftovers::none) return {};
  const std::vector<Finding> findings = find_beyond_cleaning(input);
  std::vector<Leftover> leftovers;
  const auto add = [&](std::initializer_list<FindingKind> kinds, const char* noun,
                       const char* of_what, const std::string& mend) {
    if (const std::size_t count = count_of(findings, kinds); count > 0)
      leftovers.push_back({counted(count, noun) + of_what + " left", mend});
  };
  if (!settings.fix_swaps)
    add({FindingKind::swap}, "swap", " of markers", "--fix-swaps undoes them");
  if (!settings.fill)
    add({FindingKind::gap}, "long gap", "", "--fill auto fills those of labelled points");
  add({FindingKind::frozen, FindingKind::bridged}, "frozen or bridged span", "",
      "kinemend check TAKE --gaps-out gaps.csv; kinemend clean TAKE --gaps gaps.csv --fill auto");
  add({FindingKind::repeated_frames, FindingKind::zero_frames}, "run",
      " of repeated or empty frames", listing);
  for (const Finding& finding : findings) {
    const std::string words = printable(finding.words);
    if (finding.kind == FindingKind::rate)
      leftovers.push_back({"the frame rate looks wrong", words});
    if (finding.kind == FindingKind::unit) leftovers.push_back({"the unit looks wrong", words});
  }
  return leftovers;
}

namespace {

// The findings of one kind: their number, and the worst figure with its unit.
struct Found {
  std::size_t count = 0;
  std::string worst;
};

Found found_of(const std::vector<Finding>& findings, FindingKind kind) {
  Found found;
  double largest = -1;
  for (const Finding& finding : findings) {
    if (finding.kind != kind || finding.severity == Severity::note) continue;
    ++found.count;
    if (finding.figure <= largest) continue;
    largest = finding.figure;
    found.worst = fmt::format("{} {}", figure(finding.figure), finding.unit);
  }
  return found;
}

// Why a method leaves a noisy take unchanged; empty if no reason other than the noise is known.
Leftover reason_of_method(const CleanReport& report, const CleanSettings& settings) {
  constexpr std::size_t fewest_frames = 4;  // fewer frames cannot show noise
  if (settings.strength == 0)
    return {"--strength 0 keeps the input", "a strength above 0 cleans it"};
  const auto cutoff = report.options.find("cutoff_hz");
  if (cutoff != report.options.end()) {
    const double cutoff_hz = std::get<double>(cutoff->second),
                 nyquist_hz = report.frame_rate_hz / 2;
    if (cutoff_hz >= nyquist_hz) {
      return {fmt::format("the cutoff of {} Hz is not below the Nyquist frequency of {} Hz",
                          figure(cutoff_hz), figure(nyquist_hz)),
              "a lower --cutoff-hz smooths it"};
    }
  }
  const std::size_t frames = report.frames - report.calibration_frames;
  if (frames > 0 && frames < fewest_frames) {
    return {fmt::format("too short to tell noise from motion: {}, and {} are needed",
                        counted(frames, "frame"), fewest_frames),
            "--method gaussian smooths without measuring the noise"};
  }
  return {};
}

// Joints or markers with visible noise that the method measured and left.
Leftover noise_left(const CleanReport& report, double metres_per_unit) {
  constexpr double noticeable_deg = 0.1, noticeable_m = 0.0005;
  const bool is_joints = report.kind == TakeKind::joints;
  if (!is_joints && metres_per_unit <= 0) return {};
  const double least = is_joints ? noticeable_deg : noticeable_m / metres_per_unit;
  std::size_t count = 0;
  double worst = 0;
  for (const TrackSummary& track : report.tracks) {
    if (track.noise < least) continue;
    ++count;
    worst = std::max(worst, track.noise);
  }
  if (count == 0) return {};
  return {
      fmt::format("jitter on {} left, {} {} at most", counted(count, noun_of(report.kind)),
                  figure(worst), report.unit),
      fmt::format("{} takes it for motion; --method butterworth --cutoff-hz 6 smooths it anyway",
                  report.method)};
}

// Noise that a check finds in the tracks selected for cleaning.
Leftover noise_not_measured(const CheckReport& check, const CleanReport& report) {
  std::size_t count = 0;
  double worst = 0;
  for (const Finding& finding : check.findings) {
    const bool is_cleaned = std::any_of(report.tracks.begin(), report.tracks.end(),
                                        [&](const auto& t) { return t.name == finding.track; });
    if (finding.kind != FindingKind::noise || !is_cleaned) continue;
    ++count;
    worst = std::max(worst, finding.figure);
  }
  if (count == 0) return {};
  return {fmt::format("kinemend check finds jitter on {}, {} {} at most",
                      counted(count, noun_of(report.kind)), figure(worst), check.noise_unit),
          fmt::format("{} measured none and changed nothing; --method butterworth --cutoff-hz 6 "
                      "smooths it anyway",
                      report.method)};
}

bool is_unchanged(const CleanReport& report) {
  return report.swaps.empty() && report.root_max_change == 0 &&
         std::all_of(report.tracks.begin(), report.tracks.end(),
                     [](const TrackSummary& track) { return track.frames_changed == 0; });
}

std::vector<Leftover> reasons_unchanged(const Take& take, const CleanSettings& settings,
                                        const CleanReport& report) {
  std::vector<Leftover> reasons;
  if (report.frames == 0 || report.tracks.empty()) return reasons;
  CheckSettings check_settings;
  check_settings.source = report.source.source;
  check_settings.with_stands = false;
  const CheckReport check = check_take(take, check_settings);
  const Leftover reason = reason_of_method(report, settings);
  if (!reason.what.empty()) reasons.push_back(reason);
  const auto add = [&](FindingKind kind, const auto& what, const std::string& mend) {
    if (const Found found = found_of(check.findings, kind); found.count > 0)
      reasons.push_back({what(found), mend});
  };
  // A network judges noise by more than its strength, so only noise that a check reports is listed.
  Leftover noise =
      report.method == "learned" ? Leftover{} : noise_left(report, check.metres_per_unit);
  if (noise.what.empty()) noise = noise_not_measured(check, report);
  if (!noise.what.empty() && reason.what.empty()) reasons.push_back(noise);
  add(
      FindingKind::spike,
      [](const Found& found) { return counted(found.count, "spike") + " left"; },
      report.method == "auto" || report.method == "learned" ? listing
                                                            : "--method auto repairs them");
  const bool is_joints = take.has_joints();
  add(
      FindingKind::slide,
      [](const Found& found) {
        return fmt::format("{} of standing feet left, {} at most", counted(found.count, "slide"),
                           found.worst);
      },
      !is_joints ? "markers are measured points and are not moved to hold feet"
      : settings.feet && settings.feet->mode != FeetMode::off
          ? "--feet force also holds intentional slides"
          : "--feet auto holds the feet");
  add(
      FindingKind::sink,
      [](const Found& found) {
        return fmt::format("{} of feet below the floor left, {} at most",
                           counted(found.count, "time"), found.worst);
      },
      listing);
  add(
      FindingKind::length,
      [](const Found& found) {
        return fmt::format("{} of lengths left, {} at most", counted(found.count, "change"),
                           found.worst);
      },
      listing);
  return reasons;
}

}  // namespace

void explain_unchanged(const Take& result, const CleanSettings& settings, CleanReport& report) {
  if (settings.leftovers != Leftovers::all || !is_unchanged(report)) return;
  std::vector<Leftover> reasons = reasons_unchanged(result, settings, report);
  std::move(reasons.begin(), reasons.end(), std::back_inserter(report.leftovers));
}

}  // namespace kinemend
