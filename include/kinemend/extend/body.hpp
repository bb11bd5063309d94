// Bodies as learned models see them: channels that do not depend on the position and heading of a
// person, the directions of the file's axes, or the orientation of the joints' frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

enum class BodyKind : std::uint8_t { joints, markers };
std::string_view to_string(BodyKind kind);

/// The tracks of a body that a model knows, and the references of its channels.
///
/// The body's frame at a moment is upright (y up, z ahead), lies on the floor below the body and
/// turns with its heading. Place and heading are smoothed over `trend_s`, so that noise and spikes
/// do not move the frame and channels stay linear in the measured values. The floor has one height
/// per take, the height to which the feet return, so that channels do not depend on it.
///
/// Joints: three channels each, the rotation vector Log(r^-1 q) in degrees, where q is the joint's
/// local rotation in frames that are parallel to the body's when all bones point along `bones` (for
/// the first joint: its global rotation in the body's frame), and r is its reference. Then, if
/// `with_place`, the position of the first joint in the body's frame minus `place`, in degrees: the
/// angle of an arc whose radius is a quarter of the body height, about the length of a bone.
///
/// Markers: three channels each, the position in the body's frame minus the marker's mean, in the
/// same degrees.
struct BodyLayout {
  BodyKind kind = BodyKind::joints;
  std::vector<std::string> names;     ///< N tracks; joints: parents before children, the root first
  std::vector<std::int32_t> parents;  ///< N, joints: the nearest ancestor among the tracks; -1
  std::vector<Quat> references;       ///< N, joints
  /// N, joints: unit direction of the bone from the joint to its child at rest, in the body's axes;
  /// zero if unknown.
  std::vector<Vec3> bones;
  bool with_place = true;   ///< joints
  Vec3 place;               ///< joints: mean of the first joint's position, body heights
  std::vector<Vec3> means;  ///< N, markers: mean position, body heights
  /// N, markers: 1 for the steadiest markers, which define the frame.
  std::vector<std::uint8_t> anchors;
  /// N, markers: mean position in a frame that also leans with the anchors, body heights.
  std::vector<Vec3> shape;
  double trend_s = 0.5;  ///< standard deviation of the smoothing of place and heading

  std::size_t track_count() const noexcept { return names.size(); }
  /// Returns 3 per track, and 3 for the place.
  std::size_t channel_count() const noexcept;
  /// Returns "LeftArm x", "place y".
  std::string channel_name(std::size_t channel) const;
  /// Checks the rules: lengths as above, unit rotations and bones, finite numbers, parents before
  /// children, at least three anchors. Errors: `ErrorKind::usage` naming the first track that
  /// breaks a rule.
  void validate() const;

  /// Models with equal layouts have the same channels of the same body.
  friend bool operator==(const BodyLayout&, const BodyLayout&) = default;
};

/// Computes the means and references of a set of takes, before a model is trained. Takes are added
/// one by one and are not stored.
class BodyLayoutBuilder {
 public:
  /// `names`: joints or markers, or shell patterns, to include; empty: all that move.
  /// Errors: `ErrorKind::usage` for a trend that is not positive.
  explicit BodyLayoutBuilder(std::vector<std::string> names = {}, double trend_s = 0.5);
  ~BodyLayoutBuilder();
  BodyLayoutBuilder(BodyLayoutBuilder&&) noexcept;

  /// Adds a take. The first take decides which tracks exist; each later take must have at least
  /// half of them. All frames are motion: leave a calibration pose out. Errors: `ErrorKind::usage`
  /// for a take of the other kind, for a take in which too few tracks are found, with their names,
  /// and for a name or pattern that matches nothing.
  void add(const Take& take);
  /// Returns the layout. Joints that turn by less than 0.1 degrees in all takes are left out, and
  /// so are tracks that half of the takes lack. Errors: `ErrorKind::usage` if no take was added or
  /// nothing moves.
  BodyLayout finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Maps names in a model to names in a take: "LeftArm" to "lhumerus".
using NameMap = std::map<std::string, std::string, std::less<>>;
/// Reads lines `model name,name in the take` (also with `=`; `#` starts a comment; an empty name:
/// the take has no such track). Errors: `ErrorKind::usage`, `<name>:<line>: ...`.
NameMap parse_name_map(std::string_view text, std::string_view name);
/// Returns a mapping file for a person to complete: every track of the layout with its match in the
/// take, if any, and the other names of the take as comments. Errors: `ErrorKind::usage` for a take
/// of the other kind and for a name of the map that does not exist.
std::string name_map_text(const BodyLayout& layout, const Take& take, const NameMap& names = {});

/// Which tracks of a take belong to which tracks of a layout.
struct BodyMatch {
  std::vector<std::int32_t> tracks;  ///< N: index of the joint or marker in the take, or -1
  std::vector<std::string> missing;  ///< tracks of the layout that the take lacks
  std::vector<std::string> unknown;  ///< joints that can turn, or markers, that the layout lacks
  /// N, joints: convert the take's local rotation u to the layout's: q = before * u * after (for
  /// the first joint: its global rotation when the joints above it are at rest).
  std::vector<Quat> before, after;
  Quat upright;            ///< turns the take's axes so that y points up
  double body_height = 1;  ///< height of the person, file units
  /// Joints or markers whose lowest point defines the floor; often two.
  std::vector<std::int32_t> feet;
};

/// Matches tracks by name (case, separators, subject and prefixes such as `mixamorig:` are ignored;
/// the usual spellings of one bone are equal), joints of the trunk and the neck by their order,
/// then by topology: a single joint between two matched joints. A joint whose matched ancestors
/// differ from the layout's is not matched. In a take of markers with several people, the person
/// with the most markers of the layout is used. Errors: `ErrorKind::usage` if less than half of the
/// tracks are found, or no root, or fewer than three anchors: `the model knows 24 joints, of which
/// the take lacks 20: ...`; also for a name of the map that does not exist.
BodyMatch match_body(const BodyLayout& layout, const Take& take, const NameMap& names = {});

/// The channels of a take and the data needed to write them back.
struct BodyChannels {
  PoseMatrix poses;  ///< F x D degrees; a missing sample holds the last observed value
  std::vector<std::uint8_t> observed;  ///< F x D, 1 if the sample was measured
  double frame_rate_hz = 0;            ///< of the take, at most 1,000 Hz (`window_rate_hz`)
  // The body's frame, and the scale:
  std::vector<double> headings;  ///< F, radians about y, from z
  std::vector<Vec3> places;      ///< F, on the floor, file units, in the take's axes turned upright
  double degrees_per_unit = 1;
};

/// Encodes a take whose frames are all motion. Samples of tracks that the take lacks are not
/// observed. Errors: only those of `match_body`.
BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match);
/// Encodes a take in the body's frame of `guide`, the channels of a cleaner copy of this take with
/// the same frames. Rotation vectors are the ones nearest to the guide's.
BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match,
                         const BodyChannels& guide);
/// Writes the channels of the tracks with `chosen[track]` (N, and one for the place; empty: all)
/// back into all frames of the clip that they came from. Parts that the take lacks are skipped.
/// `observed` of markers is not changed.
void decode_body(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                 Take& take, std::span<const std::uint8_t> chosen = {});

}  // namespace kinemend
