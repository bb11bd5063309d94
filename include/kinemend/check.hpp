// Checks the health of a take before cleaning: gaps, spikes, noise, swapped markers, sliding feet
// and more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

enum class FindingKind : std::uint8_t {
  gap,              ///< missing samples
  spike,            ///< samples that deviate from the neighbouring frames
  frozen,           ///< a track that repeats one sample while others move
  bridged,          ///< a straight line drawn over a gap
  noise,            ///< jitter of a track
  swap,             ///< two markers with exchanged labels
  rate,             ///< the frame rate looks wrong
  unit,             ///< the unit of length looks wrong
  length,           ///< a bone or the distance of two markers of a segment changes
  slide,            ///< a foot travels while it stands
  sink,             ///< a foot goes below the floor
  euler_flip,       ///< the file's angles jump although the rotation does not
  repeated_frames,  ///< whole frames equal to the previous one
  zero_frames,      ///< whole frames of zeros
  calibration,      ///< a calibration pose at the start
  left_out,         ///< points that are angles or forces
  no_contact,       ///< feet come near the floor but hardly ever rest on it
  expected_noise,   ///< the network of `learned` expects noise that the take does not show
  // The following kinds occur only with `CheckSettings::robot`.
  joint_speed,         ///< a joint turns faster than its limit
  joint_acceleration,  ///< a joint accelerates more than its limit
  penetration,         ///< a foot goes below the level on which it stands
  floating,            ///< a foot stands above the floor, or the body is in the air without falling
  flight,              ///< no foot touches the floor, and the body falls or the time is too short
                       ///< to tell
  jump,                ///< a rotation or a position changes within one frame and stays changed
  floor                ///< the floor is not at height 0
};
/// "gap", "euler_flip", ...
std::string_view to_string(FindingKind kind);

enum class Severity : std::uint8_t {
  note,     ///< for information
  warning,  ///< cleaning repairs it, or it may be intended
  serious   ///< makes results from this take wrong
};
std::string_view to_string(Severity severity);

struct Finding {
  FindingKind kind = FindingKind::gap;
  Severity severity = Severity::note;
  std::string track;  ///< joint or marker; "A, B" for two; empty for the whole take
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive, counted from 0; all frames if it holds throughout
  double figure = 0;           ///< how much, in `unit`
  std::string unit;            ///< "s", "deg", "mm", "cm", "%", "frames", ...
  std::string words;           ///< a sentence without track and frames
};

/// One joint or marker over the whole take, without calibration frames.
struct TrackHealth {
  std::string name;
  std::size_t gaps = 0;
  std::size_t longest_gap = 0;     ///< frames
  std::size_t missing_frames = 0;  ///< frames of all gaps
  std::size_t spikes = 0;          ///< runs of frames
  std::size_t frozen = 0;          ///< spans
  std::size_t bridged = 0;         ///< spans
  std::size_t swaps = 0;
  std::size_t flips = 0;
  double peak_speed_deg_s = 0;          ///< joints only, and only with `CheckSettings::robot`
  double peak_acceleration_deg_s2 = 0;  ///< as `peak_speed_deg_s`
  double noise = 0;  ///< standard deviation per axis: degrees of joints, file units of markers
};

/// Two markers whose labels are exchanged over a span of frames.
struct MarkerSwap {
  std::size_t first_marker = 0;
  std::size_t second_marker = 0;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive

  friend bool operator==(const MarkerSwap&, const MarkerSwap&) = default;
};

/// The figures that can have limits.
struct CheckFigures {
  std::size_t gaps = 0;
  double longest_gap_s = 0;
  double missing_percent = 0;  ///< of all samples
  double worst_noise = 0;      ///< largest of any track: degrees; file units of markers
  std::size_t spikes = 0;
  std::size_t swaps = 0;
  std::size_t frozen = 0;            ///< spans that are frozen or bridged
  std::optional<double> slide_cm;    ///< largest of any contact; empty without contact or scale
  std::optional<double> sink_cm;     ///< largest depth
  double length_change_percent = 0;  ///< largest of any bone or rigid pair
  std::size_t flips = 0;
  // Only with `CheckSettings::robot`; figures of feet need feet, an up direction and a scale.
  std::optional<double> joint_speed_deg_s, joint_acceleration_deg_s2;  ///< largest of any joint
  std::optional<std::size_t> jumps;
  std::optional<std::size_t> flights;    ///< includes flights in which the body does not fall
  std::optional<double> penetration_cm;  ///< largest depth of a foot below its standing level
  std::optional<double> floating_cm;     ///< largest height above the floor of a foot that stands
  std::optional<double> floor_cm;        ///< distance of the floor from height 0
};

/// The largest speed and acceleration allowed for a joint. The defaults come from the published
/// description of the knee of a Unitree G1: its speed, and the acceleration that its torque gives
/// to shank and foot (docs/check-robot.md).
struct JointLimits {
  double speed_deg_s = 1146;           ///< 20 rad/s (> 0)
  double acceleration_deg_s2 = 72700;  ///< 139 N m / 0.1096 kg m2 (> 0)
};

/// Limits of the joints whose names match a pattern of a shell (`matches_wildcards`).
struct NamedJointLimits {
  std::string pattern;
  JointLimits limits;
};

/// Limits that a take must not exceed if a robot or a simulated body imitates it.
struct RobotSettings {
  JointLimits limits;                    ///< limits of joints that no pattern matches
  std::vector<NamedJointLimits> joints;  ///< the last match is used
  /// Time over which speeds and accelerations are differences: a step of a controller at 50 Hz, or
  /// one frame where frames are longer (0.001 to 1).
  double step_s = 0.02;
  double penetration_cm = 5;  ///< depth of a foot below its standing level (>= 0)
  double floating_cm = 5;     ///< height of a standing foot above the floor (>= 0)
  double jump_deg = 30;       ///< change of a joint within one frame (> 0)
  double jump_cm = 10;        ///< change of the root or a marker within one frame (> 0)
  double floor_cm = 5;        ///< distance of the floor from height 0 (>= 0)
};

/// The limits above which a fault becomes a finding.
struct CheckSettings {
  double noise_deg = 0.35;            ///< jitter of a joint; cleaning starts about here (>= 0)
  double noise_cm = 0.1;              ///< jitter of a marker (>= 0)
  double shortest_stale_s = 0.05;     ///< frozen and bridged spans are at least this long, and no
                                      ///< shorter than 3 and 5 frames
  double slide_cm = 4;                ///< travel of a foot in one contact (>= 0)
  double sink_cm = 3;                 ///< depth of a foot below the floor (>= 0)
  double length_change_percent = 10;  ///< of a bone or a rigid pair (>= 0)
  std::optional<Axis> up;             ///< empty: found from the feet and the body above them
  /// Metres in a file unit. Empty: the unit of the take, else the unit that gives the body the size
  /// of a person.
  std::optional<double> metres_per_unit;
  KnownNames names;  ///< names of the joints or markers of feet, if they are not recognised
  std::optional<RobotSettings> robot;  ///< empty: these checks are left out
  bool with_stands = true;  ///< false: `CheckReport::stands` stays empty without `robot`, for speed
  std::vector<ForcePlate> plates{};  ///< of the take, with which stands are compared
  /// The system that recorded the take, as `CleanSettings::source`. It decides which noise and
  /// spikes cleaning would remove; these are the findings.
  Source source = Source::unknown;
};

/// One of several people in a take of markers.
struct SubjectHealth {
  std::string name;
  std::size_t markers = 0;
  std::optional<double> slide_cm, sink_cm;  ///< as in `CheckFigures`
};

/// The time in which a foot alone loads force plates, and how the stands of that foot differ.
struct PlateStand {
  std::vector<std::size_t> plates;  ///< their indices, ascending
  std::size_t foot = 0;             ///< index into `FootStands::sides`
  double first_s = 0, last_s = 0;   ///< begin and end of the load, from the first frame
  bool is_found = false;            ///< whether the foot stands at some time of it
  /// How much later the foot comes down and lifts off (`GroundTime`) than its load begins and ends,
  /// ms. Empty where the take shows no begin or end of either.
  std::optional<double> onset_ms, offset_ms;
};

/// How well stands agree with force plates.
struct PlateFigures {
  std::size_t loads = 0, found = 0;  ///< `PlateStand`s, and those with a stand
  /// The medians of the absolute differences; empty without any.
  std::optional<double> onset_ms, offset_ms;
};
PlateFigures plate_figures(const std::vector<PlateStand>& stands);

/// Findings that only `CheckSettings::robot` produces.
struct RobotFindings {
  std::vector<std::string> sides;  ///< sides of the legs: "left", "right"
  /// Contacts of heels and toes of joints, in frames of the take.
  std::vector<FootContact> contacts;
};

struct CheckReport {
  bool is_markers = false;
  std::size_t frames = 0;
  double frame_rate_hz = 0;
  /// At the start; only findings of kind `calibration` include them.
  std::size_t calibration_frames = 0;
  double metres_per_unit = 0;         ///< as used; 0: unknown
  std::string noise_unit;             ///< "deg", or the markers' unit
  std::vector<NoiseCharacter> noise;  ///< as `auto` measures it; a space without noise has no entry
  TakeSource source;                  ///< the source that was used for the take, and why
  CheckFigures figures;
  std::vector<TrackHealth> tracks;  ///< J, or the markers that are positions
  /// The people of a take of several people. Feet, lengths and size are checked for each person.
  std::vector<SubjectHealth> subjects;
  std::vector<Finding> findings;  ///< worst first
  std::vector<MarkerSwap> swaps;
  std::optional<RobotFindings> robot;
  FootStands stands;                     ///< of joints or markers, in frames of the take
  std::vector<PlateStand> plate_stands;  ///< by foot, then time; only of markers
  std::vector<NamedGap> stale;  ///< frozen and bridged spans, by track, then frame, for a side
                                ///< file of gaps
};

/// Runs all checks. Errors: `ErrorKind::usage` for a clip that breaks the rules of its type or a
/// setting out of range.
CheckReport check_take(const Take& take, const CheckSettings& settings = {});

/// Returns the findings that cleaning does not repair: serious findings about gaps, swaps, frames
/// and the unit, and all frozen and bridged spans. Leaves out the checks that take as long as
/// cleaning. Sorted as `CheckReport::findings`. Errors: as for `check_take`.
std::vector<Finding> find_beyond_cleaning(const Take& take);

/// Returns the spans in which two labels are exchanged, as far as the take itself proves it, sorted
/// by frame. At both ends, exchanging the labels makes both tracks continuous in position and
/// velocity. Between the ends it restores the distances to the other markers. A swap may begin or
/// end inside a gap of the two. After a single exchange no take can prove which side is wrong: the
/// shorter one is reported.
std::vector<MarkerSwap> find_swaps(const Take& clip);
/// Exchanges the samples of each span between the two markers, in place: positions, `observed` and
/// residuals. Spans that overlap are undone from the last to the first. Errors:
/// `ErrorKind::usage` for a marker or a frame that the clip does not have.
void undo_swaps(Take& clip, const std::vector<MarkerSwap>& swaps);

}  // namespace kinemend
