// Blends a track (a joint's rotations, or positions) with its input after cleaning, and reports on
// it. Frames are those of the motion, without calibration.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The change of every sample of a track.
struct TrackChanges {
  std::vector<double> amounts;  ///< degrees; file units for positions
  std::vector<Action> actions;
};

/// Returns each frame's share of the cleaned value, 0..1: the strength, and the range with its
/// slopes. `first_frame` is the number of calibration frames; there is one weight for each frame of
/// motion.
std::vector<double> frame_weights(const CleanSettings& settings, std::size_t frames,
                                  std::size_t first_frame, double frame_rate_hz);

/// A track before and after the cleaner.
template <class Sample>
struct TrackEdit {
  std::vector<Sample> before, after;
  std::vector<std::uint8_t> observed;  ///< empty means all
  std::vector<Action> stated;          ///< as the steps state it; empty: not stated

  bool is_observed(std::size_t frame) const { return observed.empty() || observed[frame] != 0; }
};

/// Blends `after` with `before` in place and returns the changes. Missing or repaired samples are
/// not blended with their input, which is meaningless. Samples that hardly changed get their input
/// value back. Joints of one or two axes are turned about these only. `most_change` is in radians.
TrackChanges blend(TrackEdit<Quat>& track, RotationOrder order, double most_change,
                   const std::vector<double>& weights);

/// The limits of changes of positions.
struct PositionLimits {
  GapTreatment gaps = GapTreatment::bridge;
  std::array<bool, 3> axes{true, true, true};  ///< the axes that may change
  double least = 0;                            ///< smaller changes are ignored; file units
  double most = std::numeric_limits<double>::infinity();  ///< file units
};
/// Returns the axes that have a channel.
std::array<bool, 3> position_axes(const std::vector<Channel>& channels);

/// Blends positions in the same way. Where gaps are cut, missing samples are not blended: they are
/// filled if the steps say so and the weight is above 0.
TrackChanges blend(TrackEdit<Vec3>& track, const PositionLimits& limits,
                   const std::vector<double>& weights);

/// The units and thresholds of a report's figures.
struct ReportScale {
  GapTreatment gaps = GapTreatment::bridge;
  double per_sample_unit = 1;  ///< factor of speeds and noise, as they are shown
  std::string unit, speed_unit;
  double slow = 0;          ///< lower peak speeds are ignored, as shown
  double small_change = 0;  ///< smaller smoothing changes are ignored, as shown
  std::size_t first_frame = 0;
  double frame_rate_hz = 0;
  double peak_loss_limit = 0;
};
/// Returns the scale of rotations, in degrees.
ReportScale joint_scale();
/// Returns the scale of marker positions in their unit (empty: unknown).
ReportScale marker_scale(const std::string& unit, double body_height);

/// A peak speed that cleaning lowered by more than the limit, as shown.
struct PeakLoss {
  double before = 0, after = 0;
  double share = 0;  ///< loss as a share of `before`
};
/// A sample that smoothing changed by far more than the noise explains, as shown.
struct LargeChange {
  double size = 0, noise = 0;
  double time_s = 0;      ///< time of the largest
  std::size_t count = 0;  ///< number of such frames
};

/// The measurements of a track before cleaning, the same for every method.
struct TrackMeasure {
  ColouredNoise coloured{};  ///< set if the noise is coloured; white noise is measured separately
  std::vector<std::uint8_t> spikes{};  ///< F, 1 for a spike; empty: none
};

/// The report on one joint or marker. `taken`: coloured noise that the method removed; a change
/// that it explains causes no warning.
struct TrackReport {
  TrackSummary summary;
  std::vector<ReportSpan> spans;
  std::optional<PeakLoss> lost_peak;
  std::optional<LargeChange> large_change;
};
template <class Sample>
TrackReport report_track(std::string name, std::size_t owner, const TrackEdit<Sample>& track,
                         const TrackChanges& changes, const TrackMeasure& measure,
                         const ColouredNoise& taken, const ReportScale& scale);

/// Returns "joint" or "marker".
const char* noun_of(TakeKind kind);

/// Returns one line for all lost peaks and one for all large changes, with the worst few by name.
std::vector<std::string> warnings_of(const std::vector<TrackReport>& tracks, TakeKind kind,
                                     const ReportScale& scale);

/// Returns the spans of one track, without those of `kept`.
std::vector<ReportSpan> spans_of(std::int32_t owner, const TrackChanges& changes,
                                 std::size_t first_frame);

}  // namespace kinemend
