#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "representation/body_alignment.hpp"
#include "representation/body_correspondence.hpp"
#include "representation/body_names.hpp"

namespace kinemend {

namespace representation {

namespace {

class JointMatcher {
 public:
  JointMatcher(const BodyLayout& layout, const Skeleton& skeleton, const NameMap& map)
      : layout_(layout), skeleton_(skeleton), mapped_(mapped_parts(layout, skeleton.names, map)) {}

  std::vector<std::int32_t> match() {
    if (!match_same_names()) {
      known_ = bone_names(layout_.names);
      found_ = bone_names(skeleton_.names);
      match_bones();
      match_chain(Bone::spine);
      match_chain(Bone::neck);
    }
    while (drop_misplaced()) {
    }
    return std::move(mapped_.parts);
  }

 private:
  void set(std::size_t part, std::size_t joint) {
    mapped_.parts[part] = static_cast<std::int32_t>(joint);
    mapped_.settled[part] = 1;
    mapped_.used[joint] = 1;
  }
  void unset(std::size_t part) {
    mapped_.used[static_cast<std::size_t>(mapped_.parts[part])] = 0;
    mapped_.parts[part] = -1;
  }

  // A take with all the names of the layout is of its skeleton.
  bool match_same_names() {
    std::vector<std::int32_t> joints;
    for (const std::string& name : layout_.names) joints.push_back(skeleton_.find(name));
    if (std::find(joints.begin(), joints.end(), -1) != joints.end()) return false;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto joint = static_cast<std::size_t>(joints[i]);
      if (mapped_.settled[i] == 0 && mapped_.used[joint] == 0) set(i, joint);
    }
    return true;
  }

  static bool is_chain(Bone bone) { return bone == Bone::spine || bone == Bone::neck; }

  // Of several joints of one bone the one of the same word, else the last, which hangs lowest.
  void match_bones() {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (mapped_.settled[i] != 0 || is_chain(known_[i].bone)) continue;
      std::size_t best = found_.size();
      for (std::size_t j = 0; j < found_.size(); ++j) {
        if (mapped_.used[j] != 0 || found_[j].side != known_[i].side) continue;
        const bool same_word = found_[j].word == known_[i].word;
        const bool same_bone = found_[j].bone != Bone::other && found_[j].bone == known_[i].bone;
        if (!same_word && !same_bone) continue;
        if (found_[j].bone != known_[i].bone) continue;
        best = j;
        if (same_word) break;
      }
      if (best < found_.size()) set(i, best);
    }
  }

  // Joints of the trunk and of the neck are told apart by their order: names differ too much.
  void match_chain(Bone bone) {
    std::vector<std::size_t> parts, joints;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (known_[i].bone == bone && mapped_.settled[i] == 0) parts.push_back(i);
    }
    for (std::size_t j = 0; j < found_.size(); ++j) {
      if (found_[j].bone == bone && mapped_.used[j] == 0) joints.push_back(j);
    }
    if (parts.empty() || joints.empty() || match_words(parts, joints)) return;
    const std::size_t pairs = std::min(parts.size(), joints.size());
    // The ends of the chain are matched first: what hangs on the upper end turns with it.
    const auto place = [&](std::size_t i, std::size_t count) {
      if (pairs == 1) return bone == Bone::spine ? count - 1 : 0;
      return (i * (count - 1) + (pairs - 1) / 2) / (pairs - 1);
    };
    for (std::size_t i = 0; i < pairs; ++i)
      set(parts[place(i, parts.size())], joints[place(i, joints.size())]);
  }

  bool match_words(const std::vector<std::size_t>& parts, const std::vector<std::size_t>& joints) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t part : parts) {
      const auto same = std::find_if(joints.begin(), joints.end(), [&](std::size_t joint) {
        return found_[joint].word == known_[part].word;
      });
      if (same == joints.end()) return false;
      pairs.emplace_back(part, *same);
    }
    for (const auto& [part, joint] : pairs) set(part, joint);
    return true;
  }

  std::int32_t part_of(std::int32_t joint) const {
    const auto found = std::find(mapped_.parts.begin(), mapped_.parts.end(), joint);
    return found == mapped_.parts.end() ? -1
                                        : static_cast<std::int32_t>(found - mapped_.parts.begin());
  }

  std::int32_t part_above(std::size_t part) const {
    std::int32_t joint = mapped_.parts[part];
    do {
      joint = skeleton_.parents[static_cast<std::size_t>(joint)];
    } while (joint >= 0 && part_of(joint) < 0);
    return joint < 0 ? -1 : part_of(joint);
  }

  // Whether a joint was let go that does not hang on the same part as in the layout.
  bool drop_misplaced() {
    for (std::size_t i = 0; i < layout_.part_count(); ++i) {
      if (mapped_.parts[i] < 0 || part_above(i) == matched_parent(layout_, mapped_.parts, i))
        continue;
      unset(i);
      return true;
    }
    return false;
  }

  const BodyLayout& layout_;
  const Skeleton& skeleton_;
  MappedParts mapped_;
  std::vector<BoneName> known_, found_;
};

std::vector<std::int32_t> feet_of(const std::vector<BoneName>& bones) {
  std::vector<std::int32_t> feet;
  for (const Side side : {Side::left, Side::right}) {
    const std::int32_t foot = find_bone(bones, Bone::foot, side);
    if (foot >= 0) feet.push_back(foot);
  }
  return feet;
}

}  // namespace

std::vector<std::int32_t> match_joints(const BodyLayout& layout, const Skeleton& skeleton,
                                       const NameMap& map) {
  return JointMatcher(layout, skeleton, map).match();
}

}  // namespace representation

BodyMatch match_body(const BodyLayout& layout, const Clip& clip, const NameMap& names) {
  using namespace representation;
  check_kind(layout, BodyKind::joints);
  BodyMatch match;
  match.parts = match_joints(layout, clip.skeleton, names);
  list_unmatched(layout, clip.skeleton.names, possible_parts(clip), match);
  const std::vector<BoneName> bones = bone_names(clip.skeleton.names);
  const RestPose rest = rest_pose(clip, bones);
  match.upright = upright_world(clip, bones, rest);
  match.stature = stature_of(clip.skeleton, bones, rest);
  match.feet = feet_of(bones);
  align_joints(layout, clip, rest, match);
  return match;
}

}  // namespace kinemend
