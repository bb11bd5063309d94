#include "clean/whole_markers.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "clean/clip_tracks.hpp"

namespace kinemend {

namespace {

// A place and how it moves, per frame.
struct PathEnd {
  Vec3 place, velocity;

  // Where the movement leads in so many frames; both are negative for what was before.
  Vec3 after(double frames, double decay_frames) const {
    return place + (decay_frames * (1 - std::exp(-frames / decay_frames))) * velocity;
  }
};

// Fills the frames between the last of one path and the first of the next; one may be absent.
void fill_between(const MarkerPath* before, const MarkerPath* after, double frame_rate_hz,
                  std::vector<Vec3>& positions) {
  const std::size_t support = bridge_support(frame_rate_hz);
  const double decay_frames = 0.1 * frame_rate_hz;
  const std::size_t first = before ? before->first_frame + before->positions.size() : 0;
  const std::size_t last = after ? after->first_frame : positions.size();
  PathEnd left, right;
  if (before) left = {before->positions.back(), end_velocity(*before, true, support)};
  if (after) right = {after->positions.front(), end_velocity(*after, false, support)};
  for (std::size_t f = first; f < last; ++f) {
    const double since = static_cast<double>(f - first + 1), until = static_cast<double>(last - f);
    const double u = !before ? 1 : !after ? 0 : since / (since + until);
    const double share = u * u * (3 - 2 * u);
    positions[f] = {};
    if (before) positions[f] += (1 - share) * left.after(since, decay_frames);
    if (after) positions[f] += share * right.after(-until, -decay_frames);
  }
}

std::vector<Vec3> whole_of(std::span<const MarkerPath> paths, std::size_t frames,
                           double frame_rate_hz) {
  std::vector<Vec3> positions(frames);
  for (std::size_t p = 0; p <= paths.size(); ++p) {
    const MarkerPath* before = p == 0 ? nullptr : &paths[p - 1];
    const MarkerPath* after = p == paths.size() ? nullptr : &paths[p];
    fill_between(before, after, frame_rate_hz, positions);
    if (!after) break;
    std::copy(after->positions.begin(), after->positions.end(),
              positions.begin() + static_cast<std::ptrdiff_t>(after->first_frame));
  }
  return positions;
}

}  // namespace

std::vector<WholeMarker> whole_markers(const MarkerClip& clip, const MarkerSelection& selection) {
  const std::vector<MarkerPath> paths = marker_paths(clip, selection);
  std::vector<WholeMarker> markers;
  std::vector<std::size_t> first_paths;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    if (!markers.empty() && markers.back().marker == paths[p].marker) continue;
    markers.push_back({paths[p].marker, {}});
    first_paths.push_back(p);
  }
  first_paths.push_back(paths.size());
  const std::size_t frames = clip.frame_count();
  for_each_parallel(markers.size(), frames * markers.size(), [&](std::size_t n) {
    const std::size_t first = first_paths[n], count = first_paths[n + 1] - first;
    markers[n].positions =
        whole_of(std::span(paths).subspan(first, count), frames, clip.frame_rate_hz);
  });
  return markers;
}

}  // namespace kinemend
