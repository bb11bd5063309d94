// The data that everything works on: a take, which is the motion of a skeleton or of markers. Its
// skeleton, the system that recorded it, and its gaps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// One column of a joint in the file.
enum class Channel : std::uint8_t {
  x_position,
  y_position,
  z_position,
  x_rotation,
  y_rotation,
  z_rotation
};

inline bool is_rotation(Channel channel) { return channel >= Channel::x_rotation; }
inline Axis axis_of(Channel channel) { return static_cast<Axis>(static_cast<int>(channel) % 3); }

/// The end of a chain: a point that has no rotation of its own.
struct EndSite {
  std::int32_t parent = 0;
  Vec3 offset;
  std::string name;  ///< often empty
};

/// How far a channel may go, degrees for rotations and file units for positions.
struct ChannelLimit {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

/// A tree of joints as parallel arrays, depth first.
struct Skeleton {
  std::vector<std::string> names;
  std::vector<std::int32_t> parents;  ///< -1 for a root
  std::vector<Vec3> offsets;          ///< from the parent joint, in its frame, file units
  /// The joint's frame in its parent's when its local rotation is identity.
  std::vector<Quat> rest_rotations;
  /// In the order of the file; empty for a fixed joint.
  std::vector<std::vector<Channel>> channels;
  std::vector<EndSite> end_sites;
  /// J, one limit per channel if the file states them (ASF); else empty.
  std::vector<std::vector<ChannelLimit>> limits;

  std::size_t joint_count() const noexcept { return names.size(); }
  /// Returns the index of the first joint of that name, or -1.
  std::int32_t find(std::string_view name) const noexcept;
  /// The rotation channels of a joint in file order.
  RotationOrder rotation_order(std::size_t joint) const;
  bool has_position_channels(std::size_t joint) const;
  /// Appends a joint and returns its index.
  std::int32_t add_joint(std::string name, std::int32_t parent, Vec3 offset,
                         std::vector<Channel> joint_channels);

  /// Checks the rules: all arrays have one length; every parent precedes its child; joint 0 is a
  /// root; offsets are finite; rest rotations have unit norm (1e-9); no channel occurs twice in a
  /// joint, except a rotation axis that does not follow itself directly (at most 3 rotation
  /// channels); end sites have joints that exist. Names may repeat and may be empty. Errors:
  /// `ErrorKind::usage` naming the first joint that breaks a rule.
  void validate() const;
};

/// Largest extent of the rest pose along an axis (end sites included), file units: the height, or
/// the arm span of a T-pose, which is nearly equal.
double body_height(const Skeleton& skeleton);

/// A length unit that files are written in.
struct LengthUnit {
  std::string_view name;  ///< "cm"
  double metres = 1;
};
/// The unit in which a skeleton of this height is a person of 1.2 to 2.5 m: m, mm, cm, inch, or the
/// unit of the CMU files (1 / 0.45 inch); empty if no unit fits.
std::optional<LengthUnit> guess_length_unit(const Skeleton& skeleton);

/// Returns position channels in the order x, y, z if asked for, then rotations in the given order.
std::vector<Channel> make_channels(bool with_position, RotationOrder order);

/// Maps known names ("LeftFoot", "LTOE") to names in a take ("bone_17", "M3"); empty: the take has
/// no such part. `parse_name_map` reads it.
using KnownNames = std::map<std::string, std::string, std::less<>>;

/// Returns the names of a take with the mapped names replaced by the known names. The subject is
/// kept: if "LTOE" is mapped to "M3", "Ann:M3" becomes "Ann:LTOE". Another part whose name is a
/// known name of the map becomes "part 3", by its place. Errors: `ErrorKind::usage` for a name that
/// the take does not have, or that occurs more than once.
std::vector<std::string> known_names(const std::vector<std::string>& names, const KnownNames& map);

/// The kind of system that recorded the motion of a take. `Take::source`, in contrast, is the file
/// that holds it.
enum class Source : std::uint8_t {
  /// The source is not known. Methods remove the noise that the take itself shows.
  unknown,
  /// Markers that several cameras see, and skeletons solved from them. As `unknown`: noise of such
  /// systems shows in the take.
  optical,
  /// Inertial or magnetic sensors on the body. Slow noise is likely, and methods that know it
  /// remove it.
  suit,
  /// Pose estimation from video, of one or several cameras, without markers. As `suit`.
  video,
  /// Skeletons from a depth camera. As `suit`.
  depth,
  /// Keys set by hand. They contain no measurement noise, so `auto` and `learned` change only gaps.
  keyframed
};

/// "unknown", "optical", ...
std::string_view to_string(Source source);
/// Returns the source of that name. Errors: `ErrorKind::usage` for an unknown name; the message
/// suggests the most similar name and lists all names.
Source parse_source(std::string_view name);
/// The names of all sources, `unknown` last.
std::vector<std::string> source_names();

/// Whether noise that is too slow to show from frame to frame is likely: true for video, depth and
/// suit.
bool expects_slow_noise(Source source) noexcept;

/// The source that is used for a take, and why.
struct TakeSource {
  Source source = Source::unknown;
  /// "given", "not known", or the place in the file: "read from the file, software: Vicon Nexus".
  std::string reason = "not known";

  friend bool operator==(const TakeSource&, const TakeSource&) = default;
};

/// The parts of a file that a reader keeps so that the file can be written back faithfully. Each
/// format has its own derived class, which only that format reads.
struct SourceDocument {
  virtual ~SourceDocument() = default;
  /// Returns the channel values of the joints exactly as in the file: F rows in the order of
  /// `Skeleton::channels`, in degrees and file units; NaN if the file has no finite number. Empty
  /// for formats without such channels.
  virtual std::vector<double> channel_values() const { return {}; }
};

/// A fact about the rest of a file, in words: {"analog", "16 channels at 1,000 Hz"}.
struct SourceFact {
  std::string name;
  std::string text;
};

struct SourceInfo {
  std::string name;    ///< for messages: the path, or "standard input"
  std::string format;  ///< "bvh"; empty for a clip made in memory
  std::shared_ptr<const SourceDocument> document;
  std::vector<SourceFact> facts{};  ///< facts that the fields of the take do not hold
  /// The takes in a file that may hold several, by their names in `ReadOptions::animation`, and the
  /// name of this take. Empty for other files.
  std::vector<std::string> animations{};
  std::string animation{};
};

/// An event that the file names: a heel strike, a foot off.
struct MarkerEvent {
  std::string label;    ///< "Foot Strike"
  std::string context;  ///< "Left"; often empty
  double time_s = 0;    ///< from frame 1 of the trial, which may lie before the first stored frame
};

/// A force plate and the load on it.
struct ForcePlate {
  std::array<Vec3, 4> corners{};  ///< in order around the plate, file units
  double rate_hz = 0;             ///< of `loads`, the first of which is at the first frame
  std::vector<double> loads;      ///< normal force, above zero under a foot; newtons in most files
};

/// A motion of F frames: J rotations of a skeleton's joints and P positions, frame-major. A take of
/// joints has a skeleton, and positions of the joints that move in their parents; a take of markers
/// has none, and its positions are points in space, most of them markers.
struct Take {
  Skeleton skeleton;  ///< J joints; empty: a take of markers
  /// Markers only: P names as the file spells them; may repeat or be empty.
  std::vector<std::string> names;
  double frame_rate_hz = 0;
  double metres_per_unit = 0;    ///< joints only, for all lengths; 0 if the file does not state it
  std::string unit;              ///< markers only: "mm"; empty if the file does not state it
  std::int64_t first_frame = 1;  ///< markers only: the number that the file gives its first frame
  std::vector<Quat> rotations;   ///< F x J unit quaternions, relative to the rest rotation
  /// F x P, file units. Joints: the position of joint 0 (its offset where it has no position
  /// channels), then the values that replace the offsets of `translated_joints`. Markers: zero
  /// where missing.
  std::vector<Vec3> positions;
  /// Joints other than 0 that have position channels, ascending.
  std::vector<std::int32_t> translated_joints;
  /// 1 if a sample was measured. Joints: F x J, for the rotations; empty: all were. Markers: F x P.
  std::vector<std::uint8_t> observed;
  /// Joints only: F x P, 1 if the position was measured; empty: all were.
  std::vector<std::uint8_t> observed_positions;
  /// Markers only: F x P, file units; -1 if missing, 0 if filled; empty if the format has no
  /// residuals.
  std::vector<float> residuals;
  /// Markers only: P, 0 for the angles, forces, moments and powers that a C3D file stores among its
  /// points, which no step changes; empty: all are positions.
  std::vector<std::uint8_t> is_position;
  std::vector<MarkerEvent> events;
  SourceInfo source;

  bool has_joints() const noexcept { return !skeleton.names.empty(); }
  std::size_t joint_count() const noexcept { return skeleton.joint_count(); }
  /// Number of columns of `observed`: joints, or markers.
  std::size_t owner_count() const noexcept { return has_joints() ? joint_count() : names.size(); }
  /// Names of these joints or markers.
  const std::vector<std::string>& owner_names() const noexcept {
    return has_joints() ? skeleton.names : names;
  }
  /// Number of points of a take of markers, including those that are not positions.
  std::size_t marker_count() const noexcept { return names.size(); }
  /// P: the number of position columns.
  std::size_t point_count() const noexcept {
    return has_joints() ? 1 + translated_joints.size() : names.size();
  }
  std::size_t frame_count() const noexcept {
    const std::size_t points = point_count();
    return points == 0 ? 0 : positions.size() / points;
  }
  double duration_s() const noexcept {
    return frame_rate_hz > 0 ? static_cast<double>(frame_count()) / frame_rate_hz : 0.0;
  }

  Quat& rotation(std::size_t frame, std::size_t joint) {
    return rotations[frame * joint_count() + joint];
  }
  Quat rotation(std::size_t frame, std::size_t joint) const {
    return rotations[frame * joint_count() + joint];
  }
  /// Returns the position of a marker. For joints, point 0 is the position of joint 0 and point k +
  /// 1 is the position of translated joint k.
  Vec3& position(std::size_t frame, std::size_t point) {
    return positions[frame * point_count() + point];
  }
  Vec3 position(std::size_t frame, std::size_t point) const {
    return positions[frame * point_count() + point];
  }
  Vec3& root_position(std::size_t frame) { return position(frame, 0); }
  Vec3 root_position(std::size_t frame) const { return position(frame, 0); }

  /// Whether the rotation of a joint, or the position of a marker, was measured.
  bool is_observed(std::size_t frame, std::size_t owner) const {
    return observed.empty() || observed[frame * owner_count() + owner] != 0;
  }
  /// Whether the position of a joint was measured; points are numbered as in `position`.
  bool is_position_observed(std::size_t frame, std::size_t point) const {
    return observed_positions.empty() || observed_positions[frame * point_count() + point] != 0;
  }
  /// Whether the point is the position of a marker, and not an angle, force, moment or power. All
  /// code that counts, cleans, fills or checks markers uses this.
  bool holds_positions(std::size_t marker) const {
    return is_position.empty() || is_position[marker] != 0;
  }
  /// How many of the points are positions: the number of markers to tell a user.
  std::size_t position_count() const noexcept;
  /// Returns the index of the first marker of that name, or -1. The whole name is tried first, then
  /// the name without its subject: `LASI` finds `Ann:LASI`.
  std::int32_t find(std::string_view name) const noexcept;

  /// Checks the rules: a valid skeleton or none, a finite positive rate, arrays of the lengths
  /// above, finite positions (for markers where observed), and rotations of unit norm (1e-6).
  /// Errors: `ErrorKind::usage` with the first frame and joint or marker that break a rule.
  void validate() const;
};

/// Returns frames [first, last) as a new take, without the source document.
Take slice(const Take& take, std::size_t first, std::size_t last);

/// Returns the number that the file gives its first frame. AMC files, tables and files of markers
/// number their frames; for other files it is 1.
std::int64_t first_frame_number(const Take& take);

/// Returns how many frames at the start are a calibration pose, 0 to 9, and not part of the motion.
/// A calibration pose is a T-pose as in the CMU files: joints other than roots are within 25
/// degrees of their rest rotation, 6 on average. A jump follows: one joint turns by more than 25
/// degrees, and the mean turn of the joints is 1.5 times that of the next step and of nine in ten
/// later steps. Noise does not hide it. Never all frames of a clip.
std::size_t leading_calibration_frames(const Take& clip);

/// Makes a take of markers with `frames` frames in which every sample is missing and every point is
/// a position.
Take make_marker_take(std::vector<std::string> names, std::size_t frames, double frame_rate_hz);

/// An estimate of the person's height in file units: 4.2 times the lower quartile of the distances
/// between any two markers of a frame, over at most 64 frames. It does not depend on position,
/// heading or the order of the markers; pose, outliers, props and a second person have little
/// effect. If the unit is known the result is at most 2.2 m. If no frame has two markers it is 1.75
/// m, or 1 if the unit is unknown.
double body_height(const Take& clip);

/// Returns the metres in a unit, by its usual names ("mm", "m", "cm", "in", "inches", ...); 0 for
/// other names.
double metres_per_unit(std::string_view unit);

/// Returns the usual name of a unit with this length in metres; empty if it has none.
std::string unit_name(double metres);

/// Returns the metres in the take's unit of length: the stated value, else, for joints, the value
/// that gives the skeleton the size of a person; 0 if neither is known.
double likely_metres_per_unit(const Take& take);

/// Returns the name without its subject: `LASI` for `Ann:LASI`.
std::string_view without_subject(std::string_view name);

/// Returns `given` if it is not `unknown`, else the source that the take's file implies by naming
/// the program that recorded it. A program that also edits or solves the motion of other systems
/// implies no source.
TakeSource source_of(const Take& take, Source given = Source::unknown);

/// A run of consecutive missing samples of one joint or marker.
struct Gap {
  /// Joint or marker; for positions of joints 0 is joint 0 and k + 1 is translated joint k.
  std::size_t track = 0;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive

  std::size_t length() const noexcept { return last_frame - first_frame + 1; }
  friend bool operator==(const Gap&, const Gap&) = default;
};

/// Returns the runs of samples that are not observed, sorted by track, then frame. Points of a
/// marker clip that are not positions have no gaps.
std::vector<Gap> find_gaps(const Take& take);
/// Returns the gaps of `Take::observed_positions`.
std::vector<Gap> find_position_gaps(const Take& clip);

/// A gap as a side file states it, for formats that cannot store gaps.
struct NamedGap {
  std::string name;  ///< a joint or marker, or a shell pattern (`*` matches all)
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive, counted from 0
};

/// Marks the samples as not observed, so that nothing uses their values. A gap of a joint is a gap
/// of its rotation and, where it has position channels, of its position too. Errors:
/// `ErrorKind::usage` for a name or a frame that the take does not have.
void mark_gaps(Take& take, std::span<const NamedGap> gaps);

/// Reads a side file: lines `name,first,last`, in the frame numbers of the take, last frame
/// inclusive. `first_frame` is the number of the take's first frame (`first_frame_number(clip)`). A
/// heading line, `#` comments, blank lines and quoted names are allowed. `name` appears in
/// messages. Errors: `unreadable_input` with the line, also for a number below `first_frame`.
std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame);
/// Returns the text of such a side file.
std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame);

}  // namespace kinemend
