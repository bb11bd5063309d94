// Finds the body part of a joint from its name, however a file spells it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::representation {

enum class Side : std::uint8_t { none, left, right };

/// A body part named by the joint that moves it, however files spell it.
enum class Bone : std::uint8_t {
  other,
  pelvis,
  spine,  ///< any joint between the pelvis and the neck
  neck,
  head,
  clavicle,
  upper_arm,
  forearm,
  hand,
  palm,  ///< between the wrist and the fingers
  hip,   ///< between the pelvis and the thigh
  thigh,
  shin,
  foot,
  toe
};

struct BoneName {
  Side side = Side::none;
  Bone bone = Bone::other;
  std::string word;  ///< lower case, without side, separators and prefixes: "forearm", "index1"
};

/// Returns the bones of a skeleton's joints by their names. The meaning of a name depends on the
/// others: "LeftShoulder" is a clavicle beside "LeftArm", but an upper arm beside "LeftCollar".
std::vector<BoneName> bone_names(const std::vector<std::string>& names);

/// Returns the last joint of that bone and side; -1 if no joint has them.
std::int32_t find_bone(const std::vector<BoneName>& bones, Bone bone, Side side);

/// Returns the name in lower case, without subject, separators and prefixes such as `mixamorig:`.
std::string plain_name(std::string_view name);

}  // namespace kinemend::representation
