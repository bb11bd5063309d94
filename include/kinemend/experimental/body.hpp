// Bodies as learned models see them: channels that do not depend on where a person stands, which
// way the person faces, which way the file's axes point and how its joints' frames are turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/pose_matrix.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

enum class BodyKind : std::uint8_t { joints, markers };
std::string_view to_string(BodyKind kind);

/// The tracks of a body that a model knows, and what its channels are measured from.
///
/// The body's frame at a moment is upright (y up, z ahead), stands on the floor below the body and
/// turns with its heading. It is a trend: place and heading smoothed over `trend_s`, so that noise
/// and spikes do not move it and channels stay linear in what was measured. The floor is one height
/// a take, that to which the feet return: takes whose floor is elsewhere are alike.
///
/// Joints: three channels each, the rotation vector Log(r^-1 q) in degrees, where q is the joint's
/// local rotation in frames that are parallel to the body's when all bones point along `bones`
/// (of the first joint: its global rotation in the body's frame), and r its reference. Then, with
/// `with_place`, the position of the first joint in the body's frame less `place`, in degrees: an
/// arc of a radius that a turn moves a bone's end by, a quarter of the body height.
///
/// Markers: three channels each, the position in the body's frame less the marker's mean, in the
/// same degrees.
struct BodyLayout {
  BodyKind kind = BodyKind::joints;
  std::vector<std::string> names;     ///< N tracks; joints: parents first, the root foremost
  std::vector<std::int32_t> parents;  ///< N, joints: the nearest ancestor among the tracks; -1
  std::vector<Quat> references;       ///< N, joints
  std::vector<Vec3> bones;            ///< N, joints: direction of the bone from the joint to its
                                      ///< child at rest, unit, body's axes; zero where unknown
  bool with_place = true;             ///< joints
  Vec3 place;                         ///< joints: mean of the first joint's position, body heights
  std::vector<Vec3> means;            ///< N, markers: mean position, body heights
  std::vector<std::uint8_t> anchors;  ///< N, markers: 1 for the steadiest, which carry the frame
  /// N, markers: mean position in a frame that also leans with the anchors, body heights.
  std::vector<Vec3> shape;
  double trend_s = 0.5;  ///< standard deviation of the smoothing of place and heading

  std::size_t track_count() const noexcept { return names.size(); }
  /// 3 a track, and 3 of the place.
  std::size_t channel_count() const noexcept;
  /// "LeftArm x"; "place y".
  std::string channel_name(std::size_t channel) const;
  /// The rules: lengths as above, unit rotations and bones, finite numbers, parents before
  /// children, three anchors at least. Errors: `ErrorKind::usage` naming the first track that
  /// breaks a rule.
  void validate() const;
};

/// What is learned of a set of takes before a model: means and references. Takes are shown one by
/// one and not kept.
class BodyLayoutBuilder {
 public:
  /// `names`: joints or markers, or shell patterns, to be learned; empty: all that move.
  /// Errors: `ErrorKind::usage` for a trend that is not positive.
  explicit BodyLayoutBuilder(std::vector<std::string> names = {}, double trend_s = 0.5);
  ~BodyLayoutBuilder();
  BodyLayoutBuilder(BodyLayoutBuilder&&) noexcept;

  /// The first take says which tracks there are; of later ones at least half must be found again.
  /// All frames are motion: leave a calibration pose out. Errors: `ErrorKind::usage` for a take of
  /// the other kind, one in which too few tracks are found, with their names, and a name or pattern
  /// that means nothing.
  void add(const Take& take);
  /// Joints that turn by less than 0.1 degrees in all takes are left out, and tracks that half of
  /// the takes lack. Errors: `ErrorKind::usage` when there was no take, or nothing that moves.
  BodyLayout finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Names in a take for names in a model: "LeftArm" to "lhumerus".
using NameMap = std::map<std::string, std::string, std::less<>>;
/// Reads lines `model name,name in the take` (also with `=`; `#` starts a comment; a name left
/// empty: the take has no such track). Errors: `ErrorKind::usage`, `<name>:<line>: ...`.
NameMap parse_name_map(std::string_view text, std::string_view name);
/// A mapping file that starts from what is known, for a person to complete: every track of the
/// layout with what it matches in the take, if anything, and the other names of the take as
/// comments. Errors: `ErrorKind::usage` for a take of the other kind and for a name of the map that
/// there is not.
std::string name_map_text(const BodyLayout& layout, const Take& take, const NameMap& names = {});

/// Which tracks of a take are those of a layout.
struct BodyMatch {
  std::vector<std::int32_t> tracks;  ///< N: index of the joint or marker in the take; -1: none
  std::vector<std::string> missing;  ///< tracks of the layout that the take lacks
  std::vector<std::string> unknown;  ///< joints that can turn, or markers, that the layout lacks
  /// N, joints: the take's local rotation u as the layout's is q = before * u * after (of the first
  /// joint: its global rotation, where the joints above it are at rest).
  std::vector<Quat> before, after;
  Quat upright;                    ///< turns the take's axes so that y points up
  double body_height = 1;          ///< of the person, file units
  std::vector<std::int32_t> feet;  ///< joints or markers whose lowest tells the floor; often two
};

/// By name (case, separators, subject and prefixes such as `mixamorig:` do not count; the usual
/// spellings of one bone are one name), joints of the trunk and the neck by their order, then by
/// topology: the one joint between two that are matched. A joint whose matched ancestors are not
/// those of the layout is no match. Of several people in a take of markers the one with the most
/// markers of the layout. Errors: `ErrorKind::usage` when less than half of the tracks are found,
/// or no root, or fewer than three anchors: `the model knows 24 joints, of which the take lacks 20:
/// ...`; for a name of the map that there is not.
BodyMatch match_body(const BodyLayout& layout, const Take& take, const NameMap& names = {});

/// The channels of a take and what is needed to write them back.
struct BodyChannels {
  PoseMatrix poses;                    ///< F x D degrees; of missing samples the last seen value
  std::vector<std::uint8_t> observed;  ///< F x D, 1 where there was a measurement
  double frame_rate_hz = 0;  ///< of the take; of one above 1,000 Hz that (`window_rate_hz`)
  // The body's frame, and the scale:
  std::vector<double> headings;  ///< F, radians about y, from z
  std::vector<Vec3> places;      ///< F, on the floor, file units, in the take's axes turned upright
  double degrees_per_unit = 1;
};

/// Every frame of `clip` is motion. Samples of tracks that the take lacks are not observed. Errors:
/// none beyond those of `match_body`.
BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match);
/// The same in the body's frame of `guide`, the channels of a cleaner copy of this take with the
/// same frames; rotation vectors are those nearest to the guide's.
BodyChannels encode_body(const Take& take, const BodyLayout& layout, const BodyMatch& match,
                         const BodyChannels& guide);
/// Writes the channels of the tracks with `chosen[track]` (N, and one of the place; empty: all)
/// back into all frames of the clip that they came from. Parts that the take lacks go nowhere. Of
/// markers `observed` is left as it is.
void decode_body(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                 Take& take, std::span<const std::uint8_t> chosen = {});

}  // namespace kinemend
