// Reports noise and spikes. The verdicts are those of the method `auto`, so that what is found here
// is what it would repair.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "check/checks.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::check {

namespace {

void add_noise(TrackHealth& track, double noise, double limit, std::size_t frames,
               CheckReport& report) {
  track.noise = noise;
  report.figures.worst_noise = std::max(report.figures.worst_noise, noise);
  if (!(noise > limit)) return;
  report.findings.push_back({FindingKind::noise, Severity::warning, track.name, 0, frames - 1,
                             noise, report.noise_unit, "jitters from frame to frame"});
}

// One finding for each run of frames, as `clean` repairs and counts them.
void add_spikes(TrackHealth& track, const std::string& name,
                const std::map<std::size_t, double>& sizes, const std::string& unit,
                CheckReport& report) {
  for (auto next = sizes.begin(); next != sizes.end();) {
    const std::size_t first = next->first;
    std::size_t last = first;
    double largest = 0;
    for (; next != sizes.end() && next->first <= last + 1; ++next) {
      last = next->first;
      largest = std::max(largest, next->second);
    }
    ++track.spikes;
    ++report.figures.spikes;
    report.findings.push_back({FindingKind::spike, Severity::warning, name, first, last, largest,
                               unit, "deviates from the neighbouring frames"});
  }
}

TakeView view_for(const Take& clip, const CheckReport& report) {
  Selection selection;
  selection.source = report.source.source;
  return view_of(clip, selection);
}

// What `auto` says of a take.
struct Verdict {
  CleanTrace trace;                                        // no noise: too short to tell
  std::vector<std::map<std::size_t, double>> spike_sizes;  // of each track, by frame
};

// What `auto` does not see, since it does not show from frame to frame, `learned` expects.
void add_slow_noise(const TakeView& take, std::vector<NoiseCharacter>& found) {
  const TrackSink nowhere = [](std::size_t, const CleanedTrack&) {};
  for (const NoiseCharacter& noise : make_learned()->clean(take, nowhere, {}).characters) {
    if (!noise.is_expected) continue;
    const auto is_known = [&](const NoiseCharacter& other) {
      return other.space == noise.space && other.strength >= 0.5 * noise.strength;
    };
    if (std::none_of(found.begin(), found.end(), is_known)) found.push_back(noise);
  }
}

Verdict verdict_of(const TakeView& take) {
  Verdict verdict;
  verdict.spike_sizes.resize(take.tracks.size());
  const TrackSink sink = [&](std::size_t n, const CleanedTrack& cleaned) {
    const Track& track = take.tracks[n];
    for (std::size_t f = 0; f < cleaned.actions.size(); ++f) {
      if (cleaned.actions[f] != Action::despiked) continue;
      verdict.spike_sizes[n][f] =
          track.space == Space::rotation
              ? degrees_per_radian * angle_between(track.rotation(f), cleaned.rotations[f])
              : norm(track.position(f) - cleaned.positions[f]);
    }
  };
  verdict.trace = make_auto({})->clean(take, sink, {});
  add_slow_noise(take, verdict.trace.characters);
  return verdict;
}

}  // namespace

void check_noise_and_spikes(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  const std::size_t frames = clip.frame_count(), joints = clip.joint_count();
  if (frames == 0) return;
  const Verdict verdict = verdict_of(view_for(clip, report));
  const std::vector<double>& noise = verdict.trace.noise;
  report.noise = verdict.trace.characters;
  for (std::size_t j = 0; j < joints && !noise.empty(); ++j)
    add_noise(report.tracks[j], noise[j], settings.noise_deg, frames, report);
  for (std::size_t j = 0; j < joints; ++j)
    add_spikes(report.tracks[j], report.tracks[j].name, verdict.spike_sizes[j], "deg", report);
  if (joints > 0) {
    add_spikes(report.tracks[0], report.tracks[0].name + " position", verdict.spike_sizes[joints],
               "", report);
  }
}

void check_noise_and_spikes(const Take& clip, const std::vector<std::size_t>& markers,
                            const CheckSettings& settings, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  if (frames == 0 || markers.empty()) return;
  const Verdict verdict = verdict_of(view_for(clip, report));
  const std::vector<double>& noise = verdict.trace.noise;
  report.noise = verdict.trace.characters;
  // Without a unit there is no limit to compare with.
  const double limit = report.metres_per_unit > 0
                           ? 0.01 * settings.noise_cm / report.metres_per_unit
                           : std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < markers.size(); ++n) {
    const std::size_t m = markers[n];
    if (!noise.empty()) add_noise(report.tracks[n], noise[m], limit, frames, report);
    add_spikes(report.tracks[n], report.tracks[n].name, verdict.spike_sizes[m], report.noise_unit,
               report);
  }
}

}  // namespace kinemend::check
