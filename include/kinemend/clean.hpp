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

#include "kinemend/check.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The noise of a capture system, measured on another take of the same system.
struct KnownNoise {
  double correlation = 0;  ///< from one measurement to the next (0 to 0.99); 0: white
  /// Noise per axis by name of joint or marker: degrees, or file units (> 0). The noise of all
  /// other tracks is measured.
  std::map<std::string, double> strengths;
};

/// Which faults of the result a report lists.
enum class Leftovers {
  none,
  beyond_cleaning,  ///< faults of the input that no cleaning mends (`find_beyond_cleaning`)
  all               ///< also why a take with faults comes back unchanged, which needs a whole check
};

/// The user's settings besides the method.
struct CleanSettings {
  bool fix_swaps = false;      ///< first exchange swapped labels (`find_swaps`); markers only
  std::vector<NamedGap> gaps;  ///< then mark these samples as missing (`mark_gaps`)
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
  /// The noise, for `auto` and the learned methods; if it is not set, they measure it. Other
  /// methods ignore it.
  std::optional<KnownNoise> noise;
  /// The system that recorded the take, for `auto` and `learned`; `unknown`: the file decides
  /// (`source_of`). Other methods ignore it.
  Source source = Source::unknown;
  double peak_loss_limit = 0.10;  ///< a larger loss of a peak speed is a warning (0..1)
  /// Fills gaps after the method has run, from the cleaned samples, without spikes that the method
  /// left in them; if it is not set, gaps stay. Gaps outside the selection and the range stay. Its
  /// own list of names must be empty.
  std::optional<FillSettings> fill;
  /// Stops feet in contact from sliding, as the last step; if it is not set, feet are not changed.
  /// `FeetMode::by_source`, the default of the program, leaves that to the source of the take.
  /// A leg keeps its slide unless all its joints are selected. Contacts are given in frames of the
  /// whole take. Markers are measured points and are not moved; a warning says so.
  std::optional<FeetSettings> feet;
  /// The faults to be listed in the report. The program and the Python package ask for all; finding
  /// them takes a check of the take.
  Leftovers leftovers = Leftovers::none;
  /// Receives the current stage and its progress (0..1, never decreasing), from one thread at a
  /// time. Stages are "cleaning", then "filling" and "feet" if asked for; each runs once from 0 to
  /// 1.
  std::function<void(std::string_view stage, double done)> progress;
};

/// The settings that are single values, each with its range, default and one sentence: command
/// line, configuration files, Python and the page follow from this table. `fill` is
/// "off" or how it is done, `feet` also "by-source", the default; `max_change` 0 is no limit.
const std::vector<OptionSpec>& clean_options();
/// Returns one of them. Errors: `ErrorKind::usage` for another name.
const OptionSpec& clean_option(std::string_view name);
/// Returns settings with these values of the table and the defaults of the others. Errors:
/// `ErrorKind::usage` for an unknown name or a value out of range.
CleanSettings clean_settings(const OptionValues& values);

/// Whether the tracks of a take are joints or markers.
enum class TakeKind { joints, markers };

/// A run of frames in which one thing was done to one joint or marker.
struct ReportSpan {
  std::int32_t joint = 0;  ///< or marker; -1 for the root position
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  Action action = Action::kept;
  /// Degrees; file units for the root position and for markers. 0 for filled markers.
  double max_change = 0;
  double rms_change = 0;
};

/// One joint or marker over the whole take: degrees for joints, file units for markers.
struct TrackSummary {
  std::string name;
  /// False for a point that is an angle or a force, which no count includes.
  bool is_position = true;
  /// Noise per axis before cleaning. It is measured as `auto` measures it, whatever the method; in
  /// takes of fewer than 4 frames it is measured as white noise. 0 for tracks that may not change.
  double noise = 0;
  /// Noise per axis that a model expects and removes, also where it cannot be measured; 0: the
  /// method has no such model or expects no noise.
  double expected_noise = 0;
  double left = 0;        ///< expected error of the result per axis; 0: unknown
  double rms_change = 0;  ///< for markers over observed samples only
  double max_change = 0;
  std::size_t frames_changed = 0;
  std::size_t frames_repaired = 0;  ///< despiked or filled
  std::size_t gaps_left = 0;        ///< markers only
  std::size_t frames_missing = 0;   ///< frames in these gaps; markers only
  /// Largest speed in degrees or file units per second, without the samples that were spikes or
  /// missing before cleaning: the distance within `peak_frames` frames, which is the shortest time
  /// (one frame to 50 ms) in which `noise` adds less than a tenth. It does not depend on the
  /// method.
  double peak_speed_before = 0;
  double peak_speed_after = 0;
  std::size_t peak_frames = 1;
};

/// A fault of a take that cleaning left unchanged.
struct Leftover {
  std::string what;  ///< "34 frozen or bridged spans left"
  /// The command or option that repairs it, or why it was left; `TAKE` stands for the take's path.
  std::string mend;
};

/// The report of cleaning a take of either kind.
struct CleanReport {
  TakeKind kind = TakeKind::joints;
  std::string method;             ///< `Cleaner::name`
  OptionValues options;           ///< `Cleaner::options`
  std::vector<MarkerSwap> swaps;  ///< swaps that were undone
  TakeSource source;              ///< the source that was used for the take, and why
  std::string unit;  ///< "deg" for joints; the file's unit for markers, empty if unknown
  std::size_t frames = 0;
  std::size_t calibration_frames = 0;  ///< at the start, left alone; joints only
  double frame_rate_hz = 0;
  /// File units: the scale that converts marker distances to degrees; markers only.
  double body_height = 0;
  std::vector<TrackSummary> tracks;  ///< J or M, including points that are not positions
  /// Noise measured before cleaning, the same for every method. Noise that the method's model
  /// expects follows, where none was measured or in addition to it (`is_expected`).
  std::vector<NoiseCharacter> noise;
  double root_rms_change = 0;  ///< file units; joints only
  double root_max_change = 0;
  std::vector<ReportSpan> spans;  ///< sorted by track, then frame; spans of `kept` are left out
  FillReport fill;                ///< result of `CleanSettings::fill`
  /// Result of `CleanSettings::feet`, for joints. `before` is the take after the method, `after`
  /// the result; `changed` and `root_changed` mark the changes of this step before blending.
  std::optional<FeetReport> feet;
  std::vector<FallBack> fall_backs;  ///< fall-backs of the method
  std::vector<std::string> notes;    ///< `CleanTrace::notes`
  std::vector<Leftover> leftovers;   ///< faults of the result, as `CleanSettings::leftovers` asks
  std::vector<std::string> warnings;
  double seconds = 0;  ///< time the cleaning took
};

struct CleanResult {
  Take take;
  CleanReport report;
};

/// Cleans a take: undoes swaps and marks gaps if asked, runs the cleaner, fills gaps if asked (this
/// does not affect measured samples), holds feet if asked, blends by strength, range and largest
/// change, and reports. Samples outside the selection and samples whose change is below rounding
/// keep their exact value. Joints: calibration frames are set aside; joints without rotation
/// channels keep their exact value; joints with one or two get rotations that these channels can
/// express. Markers: missing samples that are not filled stay missing; points that are angles or
/// forces keep their exact value; residuals are kept, and are 0 for filled samples;
/// `max_change_deg` and `root_position` are ignored. Errors: `ErrorKind::usage` for settings out of
/// range, a pattern that matches nothing, a gap that the take cannot have, and markers with a
/// method that works on joints only.
CleanResult clean_take(const Take& take, const Cleaner& cleaner,
                       const CleanSettings& settings = {});
/// Consumes the take; halves peak memory for long takes.
CleanResult clean_take(Take&& take, const Cleaner& cleaner, const CleanSettings& settings = {});

}  // namespace kinemend
