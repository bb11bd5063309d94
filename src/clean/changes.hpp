#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"

// What the pipeline does with a track (a joint's rotations, or positions) once the cleaner is done:
// blend it with its input, and report on it. Frames are those of the motion, without calibration.
namespace kinemend {

/// What became of every sample of a track.
struct TrackChanges {
  std::vector<double> amounts;  ///< degrees; file units for positions
  std::vector<Action> actions;
};

/// How far frame f goes from its input to the cleaned value, 0..1: the strength, and the range with
/// its slopes. `first_frame` is the number of calibration frames; one weight a frame of motion.
std::vector<double> frame_weights(const CleanSettings& settings, std::size_t frames,
                                  std::size_t first_frame, double frame_rate_hz);

/// One joint's rotations before and after the cleaner.
struct JointTracks {
  std::vector<Quat> before, after;
  std::vector<std::uint8_t> observed;  ///< empty means all
  std::vector<Action> stated;  ///< what the cleaner says it did; empty: nothing in particular
};

/// Blends `after` with `before` in place and says what changed. What was missing or repaired is not
/// blended with its input, which says nothing. Samples that hardly changed get their input value
/// back. Joints of one or two axes are turned about these only.
TrackChanges blend_rotations(JointTracks& tracks, RotationOrder order,
                             const CleanSettings& settings, const std::vector<double>& weights);

/// What is known of the samples of a track of positions.
struct PositionMarks {
  std::vector<std::uint8_t> observed;  ///< empty means all
  std::vector<Action> stated;  ///< what the cleaner says it did; empty: nothing in particular
};

/// The same of the positions of one joint; axes without a channel stay. Changes below `least` are
/// none.
TrackChanges blend_positions(std::span<const Vec3> before, std::span<Vec3> after,
                             const PositionMarks& marks, const std::vector<Channel>& channels,
                             const std::vector<double>& weights, double least);

/// What the report says of one joint.
struct JointReport {
  JointSummary summary;
  std::vector<ReportSpan> spans;
  std::vector<std::string> warnings;  ///< of a lost peak, and of what smoothing should not do
};
JointReport report_joint(const std::string& name, std::size_t joint, const JointTracks& tracks,
                         const TrackChanges& changes, std::size_t first_frame, double frame_rate_hz,
                         double peak_loss_limit);

/// One marker's positions before and after the cleaner.
struct MarkerTrack {
  std::vector<Vec3> before, after;
  std::vector<std::uint8_t> observed, observed_after;
  std::vector<Action> stated;  ///< what the steps say they did; empty: nothing in particular
};

/// Blends `after` with `before` in place where both were observed, no further than `max_change`.
/// Changes below `least` are none.
TrackChanges blend_marker(MarkerTrack& track, const std::vector<double>& weights, double max_change,
                          double least);

/// What marker speeds are measured by.
struct MarkerScale {
  double frame_rate_hz = 0;
  double body_height = 1;  ///< file units
  std::string unit;
};
/// What the report says of one marker.
struct MarkerTrackReport {
  MarkerSummary summary;
  std::vector<ReportSpan> spans;
  std::vector<std::string> warnings;  ///< of a lost peak, and of what smoothing should not do
};
MarkerTrackReport report_marker(const std::string& name, std::size_t marker,
                                const MarkerTrack& track, const TrackChanges& changes,
                                const MarkerScale& scale, double peak_loss_limit);

/// The spans of one track, `kept` left out.
std::vector<ReportSpan> spans_of(std::int32_t joint, const TrackChanges& changes,
                                 std::size_t first_frame);

}  // namespace kinemend
