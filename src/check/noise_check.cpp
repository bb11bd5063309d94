#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "check/checks.hpp"
#include "kinemend/methods.hpp"

// The verdicts are those of the method `auto`, so that what is found here is what it would repair.
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

void add_spike(TrackHealth& track, std::string name, std::size_t frame, double size,
               std::string unit, CheckReport& report) {
  ++track.spikes;
  ++report.figures.spikes;
  report.findings.push_back({FindingKind::spike, Severity::warning, std::move(name), frame, frame,
                             size, std::move(unit), "stands off the frames about it"});
}

}  // namespace

void check_noise_and_spikes(const Clip& clip, const CheckSettings& settings, CheckReport& report) {
  const std::size_t frames = clip.frame_count(), joints = clip.joint_count();
  if (frames == 0) return;
  Clip cleaned = clip;
  const CleanTrace trace = make_auto({})->clean(cleaned, Selection::all(clip));
  for (std::size_t j = 0; j < trace.noise_deg.size(); ++j)
    add_noise(report.tracks[j], trace.noise_deg[j], settings.noise_deg, frames, report);
  for (std::size_t i = 0; i < trace.actions.size(); ++i) {
    if (trace.actions[i] != Action::despiked) continue;
    TrackHealth& track = report.tracks[i % joints];
    const double size = angle_between(clip.local_rotations[i], cleaned.local_rotations[i]);
    add_spike(track, track.name, i / joints, degrees_per_radian * size, "deg", report);
  }
  for (std::size_t f = 0; f < trace.root_actions.size(); ++f) {
    if (trace.root_actions[f] != Action::despiked) continue;
    const double size = norm(clip.root_positions[f] - cleaned.root_positions[f]);
    add_spike(report.tracks[0], report.tracks[0].name + " position", f, size, "", report);
  }
}

void check_noise_and_spikes(const MarkerClip& clip, const std::vector<std::size_t>& markers,
                            const CheckSettings& settings, CheckReport& report) {
  const std::size_t frames = clip.frame_count(), width = clip.marker_count();
  if (frames == 0 || markers.empty()) return;
  MarkerClip cleaned = clip;
  const MarkerTrace trace = make_auto({})->clean_markers(cleaned, MarkerSelection::all(clip));
  // Without a unit nobody knows how much noise is much.
  const double limit = report.metres_per_unit > 0
                           ? 0.01 * settings.noise_cm / report.metres_per_unit
                           : std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < markers.size(); ++n) {
    const std::size_t m = markers[n];
    if (!trace.noise.empty()) add_noise(report.tracks[n], trace.noise[m], limit, frames, report);
    for (std::size_t f = 0; f < frames && !trace.actions.empty(); ++f) {
      if (trace.actions[f * width + m] != Action::despiked) continue;
      const double size = norm(clip.position(f, m) - cleaned.position(f, m));
      add_spike(report.tracks[n], report.tracks[n].name, f, size, report.noise_unit, report);
    }
  }
}

}  // namespace kinemend::check
