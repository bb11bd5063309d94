// Names kinds of findings, sorts findings by their importance, measures the distances between
// markers, and finds runs of flagged frames that chance does not explain.
#include "check/checks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/portable.hpp"

namespace kinemend {

namespace {

struct KindName {
  FindingKind kind;
  std::string_view name;
};

// Findings that affect most uses of a take come first.
constexpr std::array kinds = std::to_array<KindName>({
    {FindingKind::swap, "swap"},
    {FindingKind::zero_frames, "zero_frames"},
    {FindingKind::jump, "jump"},
    {FindingKind::rate, "rate"},
    {FindingKind::unit, "unit"},
    {FindingKind::spike, "spike"},
    {FindingKind::gap, "gap"},
    {FindingKind::frozen, "frozen"},
    {FindingKind::bridged, "bridged"},
    {FindingKind::joint_speed, "joint_speed"},
    {FindingKind::joint_acceleration, "joint_acceleration"},
    {FindingKind::repeated_frames, "repeated_frames"},
    {FindingKind::length, "length"},
    {FindingKind::slide, "slide"},
    {FindingKind::sink, "sink"},
    {FindingKind::no_contact, "no_contact"},
    {FindingKind::penetration, "penetration"},
    {FindingKind::floating, "floating"},
    {FindingKind::noise, "noise"},
    {FindingKind::expected_noise, "expected_noise"},
    {FindingKind::euler_flip, "euler_flip"},
    {FindingKind::flight, "flight"},
    {FindingKind::floor, "floor"},
    {FindingKind::calibration, "calibration"},
    {FindingKind::left_out, "left_out"},
});

std::size_t rank_of(FindingKind kind) {
  const auto* const found = std::find_if(kinds.begin(), kinds.end(),
                                         [&](const KindName& row) { return row.kind == kind; });
  return static_cast<std::size_t>(found - kinds.begin());
}

}  // namespace

std::string_view to_string(FindingKind kind) { return kinds[rank_of(kind)].name; }

std::string_view to_string(Severity severity) {
  static constexpr std::array<std::string_view, 3> names{"note", "warning", "serious"};
  return names[static_cast<std::size_t>(severity)];
}

namespace check {

void sort_worst_first(std::vector<Finding>& findings) {
  const auto key = [](const Finding& f) {
    return std::make_tuple(-static_cast<int>(f.severity), rank_of(f.kind), -f.figure, f.first_frame,
                           std::string_view(f.track));
  };
  std::stable_sort(findings.begin(), findings.end(),
                   [&](const Finding& a, const Finding& b) { return key(a) < key(b); });
}

std::vector<std::size_t> frames_looked_at(std::size_t frames) {
  constexpr std::size_t most_looked_at = 200;  // for speed, not swept
  return evenly_spread(frames, most_looked_at);
}

std::vector<Neighbour> neighbours_of(const Take& clip, const std::vector<std::size_t>& markers,
                                     std::size_t of, const std::vector<std::size_t>& frames,
                                     double tail, std::size_t fewest_frames) {
  std::vector<Neighbour> found;
  std::vector<double> distances;
  for (const std::size_t n : markers) {
    if (n == of) continue;
    distances.clear();
    for (const std::size_t f : frames) {
      if (clip.is_observed(f, of) && clip.is_observed(f, n))
        distances.push_back(norm(clip.position(f, of) - clip.position(f, n)));
    }
    if (distances.size() < fewest_frames) continue;
    const double low = quantile_of(distances, tail), high = quantile_of(distances, 1 - tail);
    found.push_back({n, median_of(distances), high - low});
  }
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::pair(a.spread, a.marker) < std::pair(b.spread, b.marker);
  });
  return found;
}

void put_largest(double value, std::optional<double>& largest) {
  largest = std::max(value, largest.value_or(value));
}

}  // namespace check

}  // namespace kinemend

namespace kinemend::check {

namespace {

struct Counts {
  std::size_t yes = 0;
  std::size_t known = 0;

  void add(Flag flag) {
    yes += flag == Flag::yes;
    known += flag != Flag::unknown;
  }
};

// Laplace's rule of succession, which never gives a share of 0 or 1.
double share_without(const Counts& all, const Counts& subset) {
  return (static_cast<double>(all.yes - subset.yes) + 1) /
         (static_cast<double>(all.known - subset.known) + 2);
}

}  // namespace

std::vector<std::vector<FrameSpan>> improbable_runs(const FlagTable& table, std::size_t shortest) {
  // Natural logarithm of the chance in docs/check.md, 1e-6. Chosen by hand, not swept.
  constexpr double log_chance = -13.8;  // 1e-6
  std::vector<Counts> of_step(table.steps), of_track(table.tracks);
  std::vector<std::uint8_t> is_witness(table.tracks);
  for (std::size_t n = 0; n < table.tracks; ++n) {
    for (std::size_t t = 0; t < table.steps; ++t) of_track[n].add(table(t, n));
    // A track that is flagged in most frames does not localise an event.
    is_witness[n] = 2 * of_track[n].yes < of_track[n].known;
    for (std::size_t t = 0; is_witness[n] != 0 && t < table.steps; ++t) of_step[t].add(table(t, n));
  }
  const auto is_improbable = [&](std::size_t track, const FrameSpan& run) {
    const Counts inside{run.length(), run.length()};
    if (is_witness[track] == 0) return false;
    double others = 0;
    for (std::size_t t = run.first; t <= run.last; ++t) {
      if (of_step[t].known > 1)
        others +=
            static_cast<double>(of_step[t].yes - 1) / static_cast<double>(of_step[t].known - 1);
    }
    others /= static_cast<double>(run.length());
    const double share = std::max(share_without(of_track[track], inside), others);
    return share < 0.5 && static_cast<double>(run.length()) * portable::log(share) < log_chance;
  };
  std::vector<std::vector<FrameSpan>> runs(table.tracks);
  for (std::size_t n = 0; n < table.tracks; ++n) {
    const auto is_yes = [&](std::size_t t) { return table(t, n) == Flag::yes; };
    for (const FrameSpan& run : runs_where(table.steps, is_yes)) {
      if (run.length() >= shortest && is_improbable(n, run)) runs[n].push_back(run);
    }
  }
  return runs;
}

}  // namespace kinemend::check
