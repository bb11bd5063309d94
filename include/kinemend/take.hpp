// The data type that everything works on: a take, which is the motion of a skeleton or of markers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/rotation.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

/// What a reader keeps of a file so that the file can be written back faithfully. Each format has
/// its own derived class, which only that format reads.
struct SourceDocument {
  virtual ~SourceDocument() = default;
  /// The channel values of the joints as they stand in the file: F rows in the order of
  /// `Skeleton::channels`, in degrees and file units; NaN where the file has no finite number.
  /// Empty for formats without such channels.
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
  std::vector<SourceFact> facts{};  ///< what the fields of the take do not say
  /// The takes in a file that may hold several, by the names that `ReadOptions::animation` has for
  /// them, and which of them this is. Empty for other files.
  std::vector<std::string> animations{};
  std::string animation{};
};

/// An event that the file names: a heel strike, a foot off.
struct MarkerEvent {
  std::string label;    ///< "Foot Strike"
  std::string context;  ///< "Left"; often empty
  double time_s = 0;    ///< from frame 1 of the trial, which may lie before the first stored frame
};

/// A motion of F frames: J rotations of a skeleton's joints and P positions, frame-major. A take of
/// joints has a skeleton, and positions of the joints that move in their parents; a take of markers
/// has none, and its positions are points of space, most of them markers.
struct Take {
  Skeleton skeleton;  ///< J joints; none: a take of markers
  std::vector<std::string>
      names;  ///< of markers: P, as the file spells them; may repeat or be empty
  double frame_rate_hz = 0;
  double metres_per_unit = 0;    ///< of joints, for all lengths; 0 where the file does not say
  std::string unit;              ///< of markers: "mm"; empty where the file does not say
  std::int64_t first_frame = 1;  ///< of markers: the number that the file gives its first frame
  std::vector<Quat> rotations;   ///< F x J unit quaternions, relative to the rest rotation
  /// F x P, file units. Joints: the position of joint 0 (its offset where it has no position
  /// channels), then what replaces the offsets of `translated_joints`. Markers: zero where missing.
  std::vector<Vec3> positions;
  std::vector<std::int32_t>
      translated_joints;  ///< joints other than 0 that have position channels, ascending
  /// 1 where a sample was measured. Joints: F x J, of the rotations; empty: all were. Markers: F x
  /// P.
  std::vector<std::uint8_t> observed;
  /// Of joints: F x P, 1 where the position was measured; empty: all were.
  std::vector<std::uint8_t> observed_positions;
  std::vector<float> residuals;  ///< of markers: F x P, file units; -1 where missing, 0 where a
                                 ///< sample was filled; empty where the format has none
  std::vector<std::uint8_t>
      is_position;  ///< of markers: P, 0 for the angles, forces, moments and powers that a C3D file
                    ///< stores among its points; no step changes these; empty: all are positions
  std::vector<MarkerEvent> events;
  SourceInfo source;

  bool has_joints() const noexcept { return !skeleton.names.empty(); }
  std::size_t joint_count() const noexcept { return skeleton.joint_count(); }
  /// Of what a mask `observed` has a column for: joints, or markers.
  std::size_t owner_count() const noexcept { return has_joints() ? joint_count() : names.size(); }
  /// Their names.
  const std::vector<std::string>& owner_names() const noexcept {
    return has_joints() ? skeleton.names : names;
  }
  /// Of a take of markers, with the points that are no positions.
  std::size_t marker_count() const noexcept { return names.size(); }
  /// P.
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
  /// Of a marker; or of joints: 0 is the position of joint 0, k + 1 that of translated joint k.
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
  /// The same of the positions of joints, counted as in `position`.
  bool is_position_observed(std::size_t frame, std::size_t point) const {
    return observed_positions.empty() || observed_positions[frame * point_count() + point] != 0;
  }
  /// Whether the point is the position of a marker, and not an angle, force, moment or power.
  /// Everything that counts, cleans, fills or checks markers asks this.
  bool holds_positions(std::size_t marker) const {
    return is_position.empty() || is_position[marker] != 0;
  }
  /// How many of the points are positions: the number of markers to tell a user.
  std::size_t position_count() const noexcept;
  /// Index of the first marker of that name, or -1. The whole name is tried first, then the name
  /// without its subject: `LASI` finds `Ann:LASI`.
  std::int32_t find(std::string_view name) const noexcept;

  /// Checks the rules: a valid skeleton or none, a finite positive rate, arrays of the lengths
  /// above, finite positions (of markers: where observed), and rotations of unit norm (1e-6).
  /// Errors: `ErrorKind::usage` with the first frame and joint or marker that break a rule.
  void validate() const;
};

/// Frames [first, last) as a new take, without the source document.
Take slice(const Take& take, std::size_t first, std::size_t last);

/// The number that the file gives its first frame: an AMC file and a table number their frames, as
/// files of markers do; 1 stands for files that do not.
std::int64_t first_frame_number(const Take& take);

/// How many frames at the start are a calibration pose, 0 to 9, and not part of the motion. A
/// calibration pose is a T-pose as in the CMU files: joints other than roots are within 25 degrees
/// of their rest rotation, 6 on average. A jump follows: one joint turns by more than 25 degrees,
/// and the mean turn of the joints is 1.5 times that of the next step and of nine in ten later
/// steps. Noise does not hide it. Never all frames of a clip.
std::size_t leading_calibration_frames(const Take& clip);

/// A take of markers of `frames` frames in which every sample is missing and every point is a
/// position.
Take make_marker_take(std::vector<std::string> names, std::size_t frames, double frame_rate_hz);

/// An estimate of the person's height in file units: 4.2 times the lower quartile of the distances
/// between any two markers of a frame, over at most 64 frames. It does not depend on position,
/// heading or the order of the markers; pose, outliers, props and a second person have little
/// effect. Where the unit is known the result is at most 2.2 m. Where no frame has two markers it
/// is 1.75 m, or 1 if the unit is unknown.
double body_height(const Take& clip);

/// Metres in a unit, by its usual names ("mm", "m", "cm", "in", "inches", ...); 0 for other names.
double metres_per_unit(std::string_view unit);

/// The usual name of a unit of so many metres; empty for lengths that have none.
std::string unit_name(double metres);

/// Metres in a unit of the take's lengths: what it states, else, of joints, what gives its skeleton
/// the size of a person; 0 where neither tells.
double likely_metres_per_unit(const Take& take);

/// The name without its subject: `LASI` for `Ann:LASI`.
std::string_view without_subject(std::string_view name);

}  // namespace kinemend
