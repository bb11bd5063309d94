// Cleans whole takes, and reports what was done to them.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/source.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The noise of a capture system, measured on another take of it.
struct KnownNoise {
  double correlation = 0;  ///< from one measurement to the next (0 to 0.99); 0: white
  /// By name of joint or marker, per axis: degrees, or file units (> 0). The noise of all others is
  /// measured.
  std::map<std::string, double> strengths;
};

/// What the user asks for besides the method.
struct CleanSettings {
  /// 0..1: geodesic blend from the input (0) to the cleaned rotation (1). It scales smoothing and
  /// the correction of feet. Spikes are repaired and gaps are filled in full at any value above 0.
  /// 0 changes nothing.
  double strength = 1.0;
  /// Largest change of an observed rotation (0..180).
  double max_change_deg = 180;
  /// Largest change of an observed marker, file units (>= 0). Positions of joints have no limit.
  double max_change = std::numeric_limits<double>::infinity();
  /// Names of joints or markers, or shell patterns (`Left*`); empty: all. A marker is also known by
  /// its name without its subject.
  std::vector<std::string> joints;
  std::vector<std::string> exclude;  ///< exceptions to `joints`
  bool root_position = true;         ///< also clean the root position, if joint 0 is selected
  /// Frames [first, last] that may change, counted from 0. The method sees the whole take; the
  /// result is blended in over 0.1 s at each end that is not an end of the take.
  std::optional<std::pair<std::size_t, std::size_t>> range;
  /// The noise, for `auto` and the learned methods; not set: they measure it. Other methods ignore
  /// it.
  std::optional<KnownNoise> noise;
  /// What recorded the take, for `auto` and `learned`; `unknown`: what the file says (`source_of`).
  /// Other methods ignore it.
  Source source = Source::unknown;
  double peak_loss_limit = 0.10;  ///< a larger loss of a peak speed is a warning (0..1)
  /// Fills gaps after the method has run, from the cleaned samples, without spikes that the method
  /// left there; not set: gaps stay. Gaps outside the selection and the range stay. Its own list of
  /// names must be empty.
  std::optional<FillSettings> fill;
  /// Stops feet in contact from sliding, as the last step; not set: no. A leg keeps its slide
  /// unless all its joints are selected. Contacts are given in frames of the whole take. Markers
  /// are measured points and are not moved: a warning says so.
  std::optional<FeetSettings> feet;
  /// Receives the current stage and its progress (0..1, never decreasing), from one thread at a
  /// time. Stages are "cleaning", then "filling" and "feet" if asked for; each runs once from 0 to
  /// 1.
  std::function<void(std::string_view stage, double done)> progress;
};

/// What the tracks of a take are.
enum class TakeKind { joints, markers };

/// A run of frames in which one thing was done to one joint or marker.
struct ReportSpan {
  std::int32_t joint = 0;  ///< or marker; -1 for the root position
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  Action action = Action::kept;
  /// Degrees; file units for the root position and for markers, of which a filled one has none.
  double max_change = 0;
  double rms_change = 0;
};

/// One joint or marker over the whole take: degrees for joints, file units for markers.
struct TrackSummary {
  std::string name;
  bool is_position = true;  ///< false for a point that is an angle or a force: no count has it
  /// Noise per axis before cleaning, measured as `auto` measures it, whatever the method; for takes
  /// of fewer than 4 frames as white noise. 0 for tracks that may not change.
  double noise = 0;
  /// Noise per axis that a model expects and takes out, also where it cannot be measured; 0: the
  /// method has no such model or expects none.
  double expected_noise = 0;
  double left = 0;        ///< how far the result is expected to be off, per axis; 0: not said
  double rms_change = 0;  ///< of a marker over the samples that were observed
  double max_change = 0;
  std::size_t frames_changed = 0;
  std::size_t frames_repaired = 0;  ///< despiked or filled
  std::size_t gaps_left = 0;        ///< markers only
  std::size_t frames_missing = 0;   ///< in the gaps that are left; markers only
  /// Largest speed in degrees or file units per second, without spikes and missing samples, as they
  /// were before cleaning: the distance within `peak_frames` frames, the shortest time (one frame
  /// to 50 ms) in which `noise` adds less than a tenth. The same for every method.
  double peak_speed_before = 0;
  double peak_speed_after = 0;
  std::size_t peak_frames = 1;
};

/// What was done to a take of either kind.
struct CleanReport {
  TakeKind kind = TakeKind::joints;
  std::string method;  ///< `Cleaner::name`
  TakeSource source;   ///< what counted as the source of the take, and why
  std::string unit;  ///< of the tracks: "deg" for joints; the file's for markers, empty if unknown
  std::size_t frames = 0;
  std::size_t calibration_frames = 0;  ///< at the start, left alone; joints only
  double frame_rate_hz = 0;
  double body_height = 0;            ///< file units: what degrees were measured by; markers only
  std::vector<TrackSummary> tracks;  ///< J or M, also points that are no positions
  /// Measured before cleaning, the same for every method; then what the method's model expects of
  /// a space without measured noise, or beside it (`is_expected`).
  std::vector<NoiseCharacter> noise;
  double root_rms_change = 0;  ///< file units; joints only
  double root_max_change = 0;
  std::vector<ReportSpan> spans;  ///< by track, then frame; without spans of `kept`
  FillReport fill;                ///< of `CleanSettings::fill`
  /// Of `CleanSettings::feet`, for joints. `before` is the take after the method, `after` the
  /// result; `changed` and `root_changed` say what the step did before blending.
  std::optional<FeetReport> feet;
  std::vector<FallBack> fall_backs;  ///< of the method
  std::vector<std::string> notes;    ///< `CleanTrace::notes`
  std::vector<std::string> warnings;
  double seconds = 0;  ///< time the cleaning took
};

struct CleanResult {
  Take take;
  CleanReport report;
};

/// Cleans a take: runs the cleaner, fills gaps if asked (measured samples come out as without
/// filling), holds feet if asked, blends by strength, range and largest change, and reports.
/// Samples outside the selection and samples whose change is below rounding keep their exact value.
/// Joints: calibration frames are set aside; joints without rotation channels keep their exact
/// value; joints with one or two get rotations that these channels can hold.
/// Markers: missing samples that are not filled stay missing; points that are angles or forces keep
/// their exact value; residuals are kept, and are 0 for filled samples; `max_change_deg` and
/// `root_position` are ignored.
/// Errors: `ErrorKind::usage` for settings out of range, a pattern that matches nothing, and
/// markers with a method that works on joints only.
CleanResult clean_take(const Take& take, const Cleaner& cleaner,
                       const CleanSettings& settings = {});
/// The same, but consumes the take; halves peak memory for long takes.
CleanResult clean_take(Take&& take, const Cleaner& cleaner, const CleanSettings& settings = {});

}  // namespace kinemend
