// A skeleton: a tree of joints with their offsets, rest rotations and channels.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/rotation.hpp"

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

}  // namespace kinemend
