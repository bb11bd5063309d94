// Finds bones that change their length, and markers that change their distance to others on their
// segment.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/checks.hpp"

namespace kinemend::check {

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
