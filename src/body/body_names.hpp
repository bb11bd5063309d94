// Reads what part of the body a joint is from its name, however a file spells it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::representation {

enum class Side : std::uint8_t { none, left, right };

/// A part of a body by what it moves, however files spell it.
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

/// What the joints of one skeleton are by their names. Names are read beside each other: a
/// "LeftShoulder" beside a "LeftArm" is a clavicle, beside a "LeftCollar" an upper arm.
std::vector<BoneName> bone_names(const std::vector<std::string>& names);

/// Lower case, without subject, separators and prefixes such as `mixamorig:`.
std::string plain_name(std::string_view name);

}  // namespace kinemend::representation
