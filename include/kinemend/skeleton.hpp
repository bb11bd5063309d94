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
  std::vector<Quat>
      rest_rotations;  ///< the joint's frame in its parent's when its local rotation is identity
  std::vector<std::vector<Channel>>
      channels;  ///< in the order of the file; empty for a fixed joint
  std::vector<EndSite> end_sites;
  /// J, one a channel where the file states them (ASF); empty where it states none.
  std::vector<std::vector<ChannelLimit>> limits;

  std::size_t joint_count() const noexcept { return names.size(); }
  /// Index of the first joint of that name; -1 when there is none.
  std::int32_t find(std::string_view name) const noexcept;
  /// The rotation channels of a joint in file order.
  RotationOrder rotation_order(std::size_t joint) const;
  bool has_position_channels(std::size_t joint) const;
  /// Appends a joint and returns its index.
  std::int32_t add_joint(std::string name, std::int32_t parent, Vec3 offset,
                         std::vector<Channel> joint_channels);

  /// The rules: arrays of one length; every parent precedes its child; joint 0 is a root; offsets
  /// finite; rest rotations of unit norm (1e-9); no channel twice in a joint save a rotation axis
  /// that is not a neighbour of itself (at most 3 rotation channels); end sites hang on joints that
  /// exist. Names may repeat and may be empty. Errors: `ErrorKind::usage` naming the first joint
  /// that breaks a rule.
  void validate() const;
};

/// Largest extent of the rest pose along an axis (end sites included), file units: the height, or
/// the arm span of a T-pose, which is about the same.
double body_height(const Skeleton& skeleton);

/// A length unit that files are written in.
struct LengthUnit {
  std::string_view name;  ///< "cm"
  double metres = 1;
};
/// The unit in which a skeleton of this height is a person of 1.2 to 2.5 m: m, mm, cm, inch, or
/// that of the CMU files (1 / 0.45 inch); none when no unit fits.
std::optional<LengthUnit> guess_length_unit(const Skeleton& skeleton);

/// Position channels in the order x, y, z where asked for, then rotations in the given order.
std::vector<Channel> make_channels(bool with_position, RotationOrder order);

/// Names that are known ("LeftFoot", "LTOE") to names in a take ("bone_17", "M3"); an empty one:
/// the take has no such part. What `parse_name_map` reads.
using KnownNames = std::map<std::string, std::string, std::less<>>;

/// The names of a take, those of the map by what they are known as. A subject stays: "Ann:M3" of
/// "LTOE" is "Ann:LTOE". What bears a name of the map and is another part loses it. Errors:
/// `ErrorKind::usage` for a name that the take does not have, or that several of it have.
std::vector<std::string> known_names(const std::vector<std::string>& names, const KnownNames& map);

}  // namespace kinemend
