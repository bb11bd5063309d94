// Holds the table of Unity's HumanBodyBones with their parents.
#include "live/vmc_bones.hpp"

#include <algorithm>

#include "kinemend/experimental/letter_case.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend {

namespace {

struct HumanBone {
  std::string_view name, parent;
};

// The names are those of Unity's enumeration HumanBodyBones, to which the VMC protocol refers; the
// parents are those of the VRM humanoid. A parent comes before its children.
constexpr HumanBone human_bones[] = {{"root", ""},
                                     {"Hips", "root"},
                                     {"Spine", "Hips"},
                                     {"Chest", "Spine"},
                                     {"UpperChest", "Chest"},
                                     {"Neck", "UpperChest"},
                                     {"Head", "Neck"},
                                     {"Jaw", "Head"},
                                     {"LeftEye", "Head"},
                                     {"RightEye", "Head"},
                                     {"LeftUpperLeg", "Hips"},
                                     {"LeftLowerLeg", "LeftUpperLeg"},
                                     {"LeftFoot", "LeftLowerLeg"},
                                     {"LeftToes", "LeftFoot"},
                                     {"RightUpperLeg", "Hips"},
                                     {"RightLowerLeg", "RightUpperLeg"},
                                     {"RightFoot", "RightLowerLeg"},
                                     {"RightToes", "RightFoot"},
                                     {"LeftShoulder", "UpperChest"},
                                     {"LeftUpperArm", "LeftShoulder"},
                                     {"LeftLowerArm", "LeftUpperArm"},
                                     {"LeftHand", "LeftLowerArm"},
                                     {"RightShoulder", "UpperChest"},
                                     {"RightUpperArm", "RightShoulder"},
                                     {"RightLowerArm", "RightUpperArm"},
                                     {"RightHand", "RightLowerArm"}};
constexpr std::string_view sides[] = {"Left", "Right"};
constexpr std::string_view fingers[] = {"Thumb", "Index", "Middle", "Ring", "Little"};
constexpr std::string_view phalanges[] = {"Proximal", "Intermediate", "Distal"};

}  // namespace

VmcBones::VmcBones(const std::vector<std::string>& more) {
  const auto add = [this](std::string name, std::string_view parent) {
    parents_.push_back(find(parent));
    keys_.push_back(lower_case(name));
    names_.push_back(std::move(name));
  };
  for (const HumanBone& bone : human_bones) add(std::string(bone.name), bone.parent);
  for (const std::string_view side : sides) {
    for (const std::string_view finger : fingers) {
      std::string parent = std::string(side) + "Hand";
      for (const std::string_view phalanx : phalanges) {
        std::string name = std::string(side).append(finger).append(phalanx);
        add(name, parent);
        parent = std::move(name);
      }
    }
  }
  for (const std::string& name : more) {
    if (find(name) < 0) add(name, names_[root]);
  }
}

std::int32_t VmcBones::find(std::string_view name) const {
  const auto found = std::find(keys_.begin(), keys_.end(), lower_case(name));
  return found == keys_.end() ? -1 : static_cast<std::int32_t>(found - keys_.begin());
}

Take VmcBones::take_of(const std::vector<std::uint8_t>& present, const std::vector<Vec3>& offsets,
                       double frame_rate_hz) const {
  const RotationOrder order{{Axis::z, Axis::x, Axis::y}, 3};
  Take take;
  take.frame_rate_hz = frame_rate_hz;
  take.metres_per_unit = 1;
  std::vector<std::int32_t> joints(count(), -1);
  for (std::size_t bone = 0; bone < count(); ++bone) {
    if (bone != root && present[bone] == 0) continue;
    std::int32_t parent = parents_[bone];
    while (parent >= 0 && joints[static_cast<std::size_t>(parent)] < 0)
      parent = parents_[static_cast<std::size_t>(parent)];
    const std::int32_t above = parent < 0 ? -1 : joints[static_cast<std::size_t>(parent)];
    const bool moves = bone == root || bone == hips;
    joints[bone] =
        take.skeleton.add_joint(names_[bone], above, offsets[bone], make_channels(moves, order));
    if (bone == hips) take.translated_joints.push_back(joints[bone]);
  }
  return take;
}

}  // namespace kinemend
