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
#include "kinemend/clip.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// The noise of a capture system, as it was measured on another take of it.
struct KnownNoise {
  double correlation = 0;  ///< from one measurement to the next (0 to 0.99); 0: white
  /// By names of joints or markers, per axis: degrees, or file units (> 0). Of others it is
  /// measured.
  std::map<std::string, double> strengths;
};

/// What the user asks for beside the method.
struct CleanSettings {
  /// 0..1: geodesic blend from the input (0) to the cleaned rotation (1). Smoothing, and what feet
  /// are moved by, goes so far; a spike is no motion to go halfway from, and is repaired whole as
  /// soon as this is above 0, as gaps are filled. 0 changes nothing at all.
  double strength = 1.0;
  /// No observed rotation turns further than this from its input (0..180).
  double max_change_deg = 180;
  /// No observed marker moves further than this from its input, file units (>= 0). Positions of
  /// joints have no limit.
  double max_change = std::numeric_limits<double>::infinity();
  /// Names of joints or markers, or shell patterns (`Left*`); empty: all. A marker is also known by
  /// its name without its subject.
  std::vector<std::string> joints;
  std::vector<std::string> exclude;  ///< taken out again
  bool root_position = true;         ///< also clean the root position, where joint 0 is selected
  /// Frames [first, last] that may change, counted from 0; the method sees all of the take, and the
  /// result is blended in over 0.1 s at either end that is not an end of the take.
  std::optional<std::pair<std::size_t, std::size_t>> range;
  /// What `auto` and the learned methods take the noise to be; not set: they find it out. Other
  /// methods do not look at it.
  std::optional<KnownNoise> noise;
  double peak_loss_limit = 0.10;  ///< a larger loss of a peak speed is a warning (0..1)
  /// Fills gaps from what the method made of the measured samples, or without the spikes that it
  /// left there; not set: no. Gaps outside the selection and the range stay. Its own list of names
  /// must be empty.
  std::optional<FillSettings> fill;
  /// Stops feet in contact from sliding, after everything else; not set: no. A leg of which not all
  /// joints are selected keeps its slide. Contacts are of frames of the whole take. Means nothing
  /// for markers, which are measured points: a warning says so.
  std::optional<FeetSettings> feet;
  /// Told what is being done and how far it is (0..1, never less than before), by one thread at a
  /// time: "cleaning", then "filling" and "feet" where asked for. Each stage comes once, from 0 to
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
  double noise = 0;         ///< noise per axis before: the method's estimate, else measured
  double rms_change = 0;    ///< of a marker over the samples that were observed
  double max_change = 0;
  std::size_t frames_changed = 0;
  std::size_t frames_repaired = 0;  ///< despiked or filled
  std::size_t gaps_left = 0;        ///< markers only
  std::size_t frames_missing = 0;   ///< in the gaps that are left; markers only
  /// Largest speed, degrees or file units a second, repaired samples left out: the way within
  /// `peak_frames` frames, which is the shortest time (one frame to 50 ms) in which the noise adds
  /// less than a tenth.
  double peak_speed_before = 0;
  double peak_speed_after = 0;
  std::size_t peak_frames = 1;
};

/// What was done to a take of either kind.
struct CleanReport {
  TakeKind kind = TakeKind::joints;
  std::string method;
  std::string unit;  ///< of the tracks: "deg" for joints; the file's for markers, empty if unknown
  std::size_t frames = 0;
  std::size_t calibration_frames = 0;  ///< at the start, left alone; joints only
  double frame_rate_hz = 0;
  double body_height = 0;             ///< file units: what degrees were measured by; markers only
  std::vector<TrackSummary> tracks;   ///< J or M, also points that are no positions
  std::vector<NoiseCharacter> noise;  ///< `CleanTrace::characters`
  double root_rms_change = 0;         ///< file units; joints only
  double root_max_change = 0;
  std::vector<ReportSpan> spans;  ///< by track, then frame; spans of `kept` are left out
  FillReport fill;                ///< of `CleanSettings::fill`
  /// Of `CleanSettings::feet`, for joints; not set without. `before` is what the method made of the
  /// take, `after` the result; `changed` and `root_changed` say what the step did before blending.
  std::optional<FeetReport> feet;
  std::vector<FallBack> fall_backs;  ///< of the method
  std::vector<std::string> warnings;
  double seconds = 0;  ///< time the cleaning took
};

struct CleanResult {
  Clip clip;
  CleanReport report;
};

struct MarkerResult {
  MarkerClip clip;
  CleanReport report;
};

/// The main path: takes calibration frames off, runs the cleaner, fills gaps if asked (what was
/// measured comes out as without), holds feet if asked, blends by strength, range and largest
/// change, and reports. Samples outside the selection, joints without rotation channels and samples
/// whose change is below 1e-9 degrees keep their exact value; the rotations of joints with one or
/// two rotation channels are those that the channels can hold. Errors: `ErrorKind::usage` for
/// settings out of range and for a joint pattern that matches nothing.
CleanResult clean_clip(const Clip& clip, const Cleaner& cleaner, const CleanSettings& settings = {},
                       std::string method_name = {});
/// The same where the take is needed no more: a long one then takes half the room.
CleanResult clean_clip(Clip&& clip, const Cleaner& cleaner, const CleanSettings& settings = {},
                       std::string method_name = {});

/// The same for markers: runs the cleaner, fills gaps if asked, blends by strength, range and
/// largest change, and reports. What is missing and not filled stays missing; points that are no
/// positions, markers outside the selection and samples whose change is below rounding keep their
/// exact value. Residuals stay, and are 0 where a sample was filled. `max_change_deg` and
/// `root_position` mean nothing here. Errors: `ErrorKind::usage` for settings out of range, a
/// pattern that matches no marker, and a method that works on joints only.
MarkerResult clean_markers(const MarkerClip& clip, const Cleaner& cleaner,
                           const CleanSettings& settings = {}, std::string method_name = {});

}  // namespace kinemend
