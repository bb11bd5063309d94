// Keeps the last frames, and feeds them to a new filter when a bone appears. Holds the table of
// bones.
#include "live/vmc_stream.hpp"

#include <algorithm>
#include <utility>

#include "kinemend/extend/text.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace {

// The number of frames after which a causal filter is as steady as one that has always run.
constexpr std::size_t warm_frames = 60;

}  // namespace

VmcStream::VmcStream(const Cleaner& cleaner, const VmcBones& bones, double frame_rate_hz, bool feet,
                     Source source, Give give)
    : cleaner_(cleaner),
      bones_(bones),
      frame_rate_hz_(frame_rate_hz),
      source_(source),
      give_(std::move(give)),
      present_(bones.count(), 0),
      offsets_(bones.count()),
      holds_feet_(feet) {
  // A method that cannot clean a humanoid fails here, before a sender connects.
  const std::vector<std::uint8_t> all(bones.count(), 1);
  latency_ = make_stream(cleaner, bones.take_of(all, offsets_, frame_rate_hz), 0, source)
                 ->latency_frames();
  kept_frames_ = 2 * latency_ + warm_frames;
  begin_anew();
}

void VmcStream::add(std::size_t bone, Quat rotation, Vec3 offset) {
  present_[bone] = 1;
  offsets_[bone] = offset;
  for (VmcFrame& frame : history_) {
    frame.rotations[bone] = rotation;
    if (bone <= VmcBones::hips) frame.positions[bone] = offset;
    frame.measured[bone] = 1;
  }
  is_outdated_ = true;
}

void VmcStream::push(VmcFrame frame) {
  if (history_.size() == kept_frames_) history_.pop_front();
  history_.push_back(std::move(frame));
  ++pushed_;
  if (is_outdated_) {
    begin_anew();
  } else {
    pass(history_.back());
  }
}

void VmcStream::begin_anew() {
  is_outdated_ = false;
  const Take like = bones_.take_of(present_, offsets_, frame_rate_hz_);
  stream_ = make_stream(cleaner_, like, 0, source_);
  if (holds_feet_) feet_.emplace(like);
  joints_.assign(bones_.count(), 0);
  order_.clear();
  for (std::size_t bone = 0; bone < bones_.count(); ++bone) {
    if (bone != VmcBones::root && !has(bone)) continue;
    joints_[bone] = order_.size();
    order_.push_back(bone);
  }
  made_ = pushed_ - history_.size();
  for (const VmcFrame& frame : history_) pass(frame);
}

void VmcStream::pass(const VmcFrame& frame) {
  in_.rotations.clear();
  in_.observed.clear();
  for (const std::size_t bone : order_) {
    in_.rotations.push_back(frame.rotations[bone]);
    in_.observed.push_back(frame.measured[bone] != 0 || !has(bone) ? 1 : 0);
  }
  // A mask would keep filters from the fast path that needs no memory.
  if (std::find(in_.observed.begin(), in_.observed.end(), 0) == in_.observed.end())
    in_.observed.clear();
  const std::size_t points = has(VmcBones::hips) ? 2 : 1;
  in_.positions.assign(frame.positions.begin(), frame.positions.begin() + points);
  if (!stream_->push(in_, out_)) return;
  const std::size_t number = made_++;
  if (number < given_) return;
  ++given_;
  if (feet_) feet_->hold(out_.rotations, out_.positions);
  // The frame is still stored, because more frames are stored than the filter looks ahead.
  give_(number, history_[number + history_.size() - pushed_]);
}

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
