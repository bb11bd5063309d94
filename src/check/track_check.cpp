// Reports noise and spikes with the verdicts of the method `auto`, so that findings match what it
// would repair; bones that change their length, and markers that change their distance to others on
// their segment.
#include <fmt/format.h>

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

// Adds one finding for each run of frames, as `clean` repairs and counts them.
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

// The verdict of `auto` on a take, and the noise that `learned` expects.
struct Verdict {
  CleanTrace trace;                                        // no noise: too short to measure
  std::vector<std::map<std::size_t, double>> spike_sizes;  // for each track, by frame
  std::vector<NoiseCharacter> expected;  // noise that `auto` does not see; `is_expected`: slow
};

// Returns the error per axis that the network expects in the tracks of a space: the median of the
// tracks from which it removes noise, or 0 if these are less than half of all.
double expected_strength(const TakeView& take, const CleanTrace& trace, Space space) {
  // The references of real2/ and worlds/train-allowed have a smaller share; takes of video and
  // depth cameras a larger one. Not swept.
  constexpr double least_share = 0.5;
  double tracks = 0;
  std::vector<double> strengths;
  for (std::size_t n = 0; n < trace.noise.size(); ++n) {
    if (take.tracks[n].space != space || !take.tracks[n].selected) continue;
    ++tracks;
    if (trace.noise[n] > 0)
      strengths.push_back(
          std::sqrt(trace.noise[n] * trace.noise[n] + trace.left[n] * trace.left[n]));
  }
  const bool is_enough =
      !strengths.empty() && static_cast<double>(strengths.size()) >= least_share * tracks;
  return is_enough ? median_of(strengths) : 0;
}

// Noise that does not show from frame to frame is invisible to `auto`. The network returns all
// noise that it expects, visible or not.
std::vector<NoiseCharacter> noise_expected(const TakeView& take,
                                           const std::vector<NoiseCharacter>& measured) {
  const TrackSink nowhere = [](std::size_t, const CleanedTrack&) {};
  std::vector<NoiseCharacter> expected;
  if (take.source == Source::optical || take.source == Source::keyframed) return expected;
  TakeView asked = take;
  if (asked.source == Source::unknown) asked.source = Source::video;
  const CleanTrace trace = make_learned()->clean(asked, nowhere, {});
  // If the network cannot judge the take it falls back to `auto`, and the remaining error is
  // unknown.
  if (trace.left.empty()) return expected;
  for (const Space space : {Space::rotation, Space::position}) {
    // The network has not learned the places of a body.
    if (space == Space::position && take.joints != nullptr) continue;
    const double strength = expected_strength(take, trace, space);
    const auto explains = [&](const NoiseCharacter& noise) {
      return noise.space == space && noise.strength >= 0.5 * strength;
    };
    if (strength == 0 || std::any_of(measured.begin(), measured.end(), explains)) continue;
    const bool is_slow = std::any_of(
        trace.characters.begin(), trace.characters.end(),
        [&](const NoiseCharacter& noise) { return noise.space == space && noise.is_expected; });
    expected.push_back({.space = space, .strength = strength, .is_expected = is_slow});
  }
  return expected;
}

void report_expected(const Verdict& verdict, std::size_t frames, CheckReport& report) {
  for (const NoiseCharacter& noise : verdict.expected) {
    // The spectrum of other noise is unknown.
    if (noise.is_expected) report.noise.push_back(noise);
    report.findings.push_back(
        {FindingKind::expected_noise, Severity::note, "", 0, frames - 1, noise.strength,
         report.noise_unit,
         "the model expects noise, which this take alone cannot tell from motion; if it comes from "
         "video, a depth camera or a suit, try: kinemend clean --source video"});
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
  verdict.expected = noise_expected(take, verdict.trace.characters);
  return verdict;
}

}  // namespace

void check_noise_and_spikes(const Rows& rows, const CheckSettings& settings, CheckReport& report) {
  const std::size_t frames = rows.clip.frame_count();
  if (frames == 0 || rows.tracks.empty()) return;
  const Verdict verdict = verdict_of(view_for(rows.clip, report));
  const std::vector<double>& noise = verdict.trace.noise;
  report.noise = verdict.trace.characters;
  const bool joints = rows.clip.has_joints();
  // Without a unit no limit applies to markers.
  const double limit = joints ? settings.noise_deg
                       : report.metres_per_unit > 0
                           ? 0.01 * settings.noise_cm / report.metres_per_unit
                           : std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < rows.tracks.size(); ++n) {
    TrackHealth& track = report.tracks[n];
    const std::size_t owner = rows.tracks[n];
    if (!noise.empty()) add_noise(track, noise[owner], limit, frames, report);
    add_spikes(track, track.name, verdict.spike_sizes[owner], report.noise_unit, report);
  }
  if (joints) {
    add_spikes(report.tracks[0], report.tracks[0].name + " position",
               verdict.spike_sizes[rows.tracks.size()], "", report);
  }
  report_expected(verdict, frames, report);
}

namespace {

// The largest value that lasts for three frames, and its frame: single frames are spikes. Negative
// values are unknown.
struct Peak {
  double value = 0;
  std::size_t frame = 0;
};

Peak lasting_peak(const std::vector<double>& values) {
  Peak peak;
  for (std::size_t t = 1; t + 1 < values.size(); ++t) {
    const double least = std::min({values[t - 1], values[t], values[t + 1]});
    if (least > peak.value) peak = {least, t};
  }
  return peak;
}

// Returns the frames around a peak in which a value is at least half of it.
FrameSpan about(const std::vector<double>& values, const Peak& peak) {
  FrameSpan span{peak.frame, peak.frame};
  while (span.first > 0 && values[span.first - 1] > 0.5 * peak.value) --span.first;
  while (span.last + 1 < values.size() && values[span.last + 1] > 0.5 * peak.value) ++span.last;
  return span;
}

void report_length(const std::vector<double>& change_percent, const std::string& track,
                   const CheckSettings& settings, std::string words, CheckReport& report) {
  const Peak peak = lasting_peak(change_percent);
  report.figures.length_change_percent = std::max(report.figures.length_change_percent, peak.value);
  if (!(peak.value > settings.length_change_percent)) return;
  const FrameSpan span = about(change_percent, peak);
  report.findings.push_back({FindingKind::length, Severity::warning, track, span.first, span.last,
                             peak.value, "%", std::move(words)});
}

// Some skeletons have a reference point above the hips; the distance between the two is not a bone.
bool carries_the_body(const Skeleton& skeleton, std::int32_t joint) {
  for (std::int32_t parent = skeleton.parents[static_cast<std::size_t>(joint)]; parent >= 0;
       parent = skeleton.parents[static_cast<std::size_t>(parent)]) {
    if (std::count(skeleton.parents.begin(), skeleton.parents.end(), parent) > 1) return false;
  }
  return true;
}

// Returns markers at a nearly constant distance, as those on the same segment are.
std::vector<Neighbour> rigid_neighbours(const Take& clip, const std::vector<std::size_t>& markers,
                                        std::size_t of, const std::vector<std::size_t>& frames) {
  // The spread of a rigid distance, 10th to 90th percentile, relative to the distance. Chosen by
  // hand, not swept.
  constexpr double tail = 0.1, rigid_share = 0.04;
  // The number of neighbours kept, and of frames in which both are seen. Chosen by hand, not swept.
  constexpr std::size_t wanted = 4, fewest_frames = 20;
  std::vector<Neighbour> found = neighbours_of(clip, markers, of, frames, tail, fewest_frames);
  std::erase_if(found, [](const Neighbour& n) {
    return !(n.distance > 0 && n.spread < rigid_share * n.distance);
  });
  if (found.size() > wanted) found.resize(wanted);
  return found;
}

// A marker that slips on its segment changes its distance to most neighbours; they change theirs
// only to it.
std::vector<double> departures(const Take& clip, std::size_t marker,
                               const std::vector<Neighbour>& neighbours) {
  std::vector<double> result(clip.frame_count(), -1), now;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (!clip.is_observed(f, marker)) continue;
    now.clear();
    for (const Neighbour& n : neighbours) {
      if (!clip.is_observed(f, n.marker)) continue;
      const double distance = norm(clip.position(f, marker) - clip.position(f, n.marker));
      now.push_back(100 * std::fabs(distance - n.distance) / n.distance);
    }
    if (now.size() >= 2) result[f] = quantile_of(now, 0.34);
  }
  return result;
}

void check_bones(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  const std::size_t width = clip.translated_joints.size(), frames = clip.frame_count();
  const double least_length = 0.01 * body_height(clip.skeleton);
  for (std::size_t i = 0; i < width; ++i) {
    if (carries_the_body(clip.skeleton, clip.translated_joints[i])) continue;
    std::vector<double> lengths(frames);
    for (std::size_t f = 0; f < frames; ++f) lengths[f] = norm(clip.position(f, 1 + i));
    std::vector<double> sorted = lengths;
    const double usual = median_of(sorted);
    if (!(usual > least_length)) continue;
    for (double& length : lengths) length = 100 * std::fabs(length - usual) / usual;
    const auto joint = static_cast<std::size_t>(clip.translated_joints[i]);
    report_length(lengths, clip.skeleton.names[joint], settings,
                  "the bone that leads to it changes its length", report);
  }
}

}  // namespace

void check_lengths(const Rows& rows, const CheckSettings& settings, CheckReport& report) {
  const Take& clip = rows.clip;
  if (clip.has_joints()) check_bones(clip, settings, report);
  const std::vector<std::size_t> frames = frames_looked_at(clip.frame_count());
  for (const Subject& subject : rows.subjects) {
    for (const std::size_t m : subject.markers) {
      const std::vector<Neighbour> neighbours = rigid_neighbours(clip, subject.markers, m, frames);
      if (neighbours.size() < 2) continue;
      report_length(departures(clip, m, neighbours), clip.names[m], settings,
                    fmt::format("moves away from its place between {} and {}",
                                clip.names[neighbours[0].marker], clip.names[neighbours[1].marker]),
                    report);
    }
  }
}

}  // namespace kinemend::check
