#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/pose_matrix.hpp"
#include "tracks/rotation_track.hpp"

// Markers as the filters see them: paths without long gaps.
namespace kinemend {

/// A stretch of one marker's way. It starts and ends with an observed sample, and none of its gaps
/// is longer than `longest_bridge`.
struct MarkerPath {
  std::size_t marker = 0;
  std::size_t first_frame = 0;
  std::vector<Vec3> positions;         ///< gaps bridged
  std::vector<std::uint8_t> observed;  ///< one a position; empty: all of them
};

/// Frames of the longest gap that is bridged: 0.25 s.
std::size_t longest_bridge(double frame_rate_hz);
/// Frames on either side of a gap that the bridge across it looks at: 0.05 s, at least 3.
std::size_t bridge_support(double frame_rate_hz);

/// Whether a marker is selected and a position.
bool marker_selected(const MarkerClip& clip, const MarkerSelection& selection, std::size_t marker);
/// The paths of the selected markers, by marker, then frame. A bridge is the cubic that leaves and
/// meets the observed samples at their own velocity (by least squares).
std::vector<MarkerPath> marker_paths(const MarkerClip& clip, const MarkerSelection& selection);
/// Velocity, per frame, at the last (else the first) sample of a path: that of the straight line of
/// least squares through up to `support` observed samples; zero where fewer than three stand
/// together.
Vec3 end_velocity(const MarkerPath& path, bool at_last, std::size_t support);
/// Writes the observed samples back.
void put_back(const MarkerPath& path, MarkerClip& clip);

/// Standard deviation per axis of the white noise on what was observed of one marker.
double observed_noise(const MarkerClip& clip, std::size_t marker);

/// Runs `filter` on every path of the selected markers, in parallel, and writes what was observed
/// back.
MarkerTrace filter_marker_paths(MarkerClip& clip, const MarkerSelection& selection,
                                const std::function<void(MarkerPath&)>& filter);
/// The same for filters of the form `filter(track, weights)`, samples of weight 0 counting for
/// nothing.
MarkerTrace filter_marker_tracks(
    MarkerClip& clip, const MarkerSelection& selection,
    const std::function<void(VectorTrack&, const std::vector<double>&)>& filter);
/// The same for filters that work on channels side by side: blocks of paths over the same frames,
/// three channels each, from the first position on.
MarkerTrace filter_marker_channels(MarkerClip& clip, const MarkerSelection& selection,
                                   const std::function<void(PoseMatrix&)>& filter);

/// The distance that a turn of one radian moves a marker by: a quarter of the stature, about the
/// length of a limb's segment. It puts options in degrees on the scale of positions.
inline double marker_reach(double body_height) { return body_height / 4; }

/// Runs the marker filter of a causal cleaner from the first frame to the last.
MarkerTrace clean_markers_causally(const Cleaner& cleaner, MarkerClip& clip,
                                   const MarkerSelection& selection);

/// A marker filter that treats each marker by itself: a copy of `start` for each, whose
/// `step(position, seen)` returns the cleaned position. After a gap longer than `longest_bridge` a
/// marker starts afresh.
template <class PositionStep>
class TrackMarkerFilter final : public MarkerFilter {
 public:
  TrackMarkerFilter(const MarkerClip& like, PositionStep start)
      : start_(std::move(start)),
        longest_(longest_bridge(like.frame_rate_hz)),
        steps_(like.marker_count(), start_),
        missing_(like.marker_count()) {}

  void filter(MarkerFrame& frame) override {
    for (std::size_t m = 0; m < steps_.size(); ++m) {
      const bool seen = frame.observed.empty() || frame.observed[m] != 0;
      if (seen && missing_[m] > longest_) steps_[m] = start_;
      missing_[m] = seen ? 0 : missing_[m] + 1;
      const Vec3 result = steps_[m].step(seen ? frame.positions[m] : Vec3{}, seen);
      if (seen) frame.positions[m] = result;
    }
  }

 private:
  PositionStep start_;
  std::size_t longest_;
  std::vector<PositionStep> steps_;
  std::vector<std::size_t> missing_;  ///< frames since the marker was seen
};

}  // namespace kinemend
