// Finds the joints of a layout in a clip, by name and then by topology. Files name the joints of
// trunk and neck in many ways, so these are found by the limbs attached to them, or by their names.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/body_correspondence.hpp"
#include "body/body_names.hpp"
#include "body/body_rest.hpp"

namespace kinemend::representation {

namespace {

// A tree of named joints, of a skeleton or of a layout.
struct NamedTree {
  const std::vector<BoneName>& bones;
  const std::vector<std::int32_t>& parents;  // -1 for a root

  // Returns the nearest joint above both, or the one of them that is above the other; -1: none.
  std::int32_t common_ancestor(std::int32_t a, std::int32_t b) const {
    if (b < 0) return -1;
    while (a >= 0 && !is_above(a, b)) a = parents[static_cast<std::size_t>(a)];
    return a;
  }
  bool is_above(std::int32_t ancestor, std::int32_t joint) const {
    while (joint >= 0 && joint != ancestor) joint = parents[static_cast<std::size_t>(joint)];
    return joint >= 0;
  }
};

// The joints from the hips to the joint that carries the arms (included), and those from there to
// the head, bottom up. They are found by the limbs attached to them, because files name them in
// many ways. Both are empty if pelvis, arms or head are not found.
struct BodyChains {
  std::vector<std::size_t> trunk, neck;
};

// Returns the joints from just below `top` down to `bottom`, which is included if `with_bottom`.
std::vector<std::size_t> path(const NamedTree& tree, std::int32_t top, std::int32_t bottom,
                              bool with_bottom) {
  std::vector<std::size_t> joints;
  for (std::int32_t j = bottom; j >= 0 && j != top; j = tree.parents[static_cast<std::size_t>(j)]) {
    if (j != bottom || with_bottom) joints.push_back(static_cast<std::size_t>(j));
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

BodyChains chains_by_topology(const NamedTree& tree) {
  const auto find = [&](Bone bone, Side side) { return find_bone(tree.bones, bone, side); };
  const std::int32_t chest =
      tree.common_ancestor(find(Bone::upper_arm, Side::left), find(Bone::upper_arm, Side::right));
  const std::int32_t head = find(Bone::head, Side::none);
  // If the legs are attached to a joint above the pelvis, the trunk begins above that joint.
  std::int32_t hips = find(Bone::pelvis, Side::none);
  const std::int32_t legs =
      tree.common_ancestor(find(Bone::thigh, Side::left), find(Bone::thigh, Side::right));
  if (legs >= 0 && hips >= 0 && tree.is_above(hips, legs)) hips = legs;
  if (hips < 0 || chest < 0 || head < 0 || hips == chest || !tree.is_above(hips, chest) ||
      !tree.is_above(chest, head))
    return {};
  return {path(tree, hips, chest, true), path(tree, chest, head, false)};
}

// Finds the chains by the names of their joints.
BodyChains chains_by_name(const std::vector<BoneName>& bones) {
  BodyChains chains;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (bones[i].bone == Bone::spine) chains.trunk.push_back(i);
    if (bones[i].bone == Bone::neck) chains.neck.push_back(i);
  }
  return chains;
}

class JointMatcher {
 public:
  JointMatcher(const BodyLayout& layout, const Take& clip, const NameMap& map)
      : layout_(layout),
        skeleton_(clip.skeleton),
        turning_(possible_tracks(clip)),
        mapped_(mapped_tracks(layout, clip.skeleton.names, map)) {}

  std::vector<std::int32_t> match() {
    if (!match_same_names()) {
      known_ = bone_names(layout_.names);
      found_ = bone_names(skeleton_.names);
      match_chains();
      match_bones();
      match_root();
      drop_misplaced();
      match_between();
    }
    drop_misplaced();
    return std::move(mapped_.tracks);
  }

 private:
  void set(std::size_t track, std::size_t joint) {
    mapped_.tracks[track] = static_cast<std::int32_t>(joint);
    mapped_.settled[track] = 1;
    mapped_.used[joint] = 1;
  }
  bool is_free(std::size_t joint) const { return mapped_.used[joint] == 0 && turning_[joint] != 0; }

  // A take that has all names of the layout has its skeleton.
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

  void match_chains() {
    BodyChains known = chains_by_topology({known_, layout_.parents});
    BodyChains found = chains_by_topology({found_, skeleton_.parents});
    if (known.trunk.empty() || found.trunk.empty()) {
      known = chains_by_name(known_);
      found = chains_by_name(found_);
    }
    match_chain(known.trunk, found.trunk, true);
    match_chain(known.neck, found.neck, false);
  }

  // Matches joints of the trunk or the neck by their order, because their names differ too much.
  // The ends of the chain are matched first, because the upper end carries other limbs.
  void match_chain(std::vector<std::size_t> tracks, std::vector<std::size_t> joints,
                   bool last_first) {
    std::erase_if(tracks, [&](std::size_t track) { return mapped_.settled[track] != 0; });
    std::erase_if(joints, [&](std::size_t joint) { return !is_free(joint); });
    if (tracks.empty() || joints.empty() || match_words(tracks, joints)) return;
    const std::size_t pairs = std::min(tracks.size(), joints.size());
    const auto place = [&](std::size_t i, std::size_t count) {
      if (pairs == 1) return last_first ? count - 1 : 0;
      return (i * (count - 1) + (pairs - 1) / 2) / (pairs - 1);
    };
    for (std::size_t i = 0; i < pairs; ++i)
      set(tracks[place(i, tracks.size())], joints[place(i, joints.size())]);
  }

  bool match_words(const std::vector<std::size_t>& tracks, const std::vector<std::size_t>& joints) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t track : tracks) {
      const auto same = std::find_if(joints.begin(), joints.end(), [&](std::size_t joint) {
        return found_[joint].word == known_[track].word;
      });
      if (same == joints.end()) return false;
      pairs.emplace_back(track, *same);
    }
    for (const auto& [track, joint] : pairs) set(track, joint);
    return true;
  }

  // Matches bones by name. Among several joints of a bone it takes the one with the same word, else
  // the last, which is the lowest.
  void match_bones() {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const BoneName& known = known_[i];
      if (mapped_.settled[i] != 0 || known.bone == Bone::spine || known.bone == Bone::neck)
        continue;
      std::size_t best = found_.size();
      for (std::size_t j = 0; j < found_.size(); ++j) {
        const bool same_word = found_[j].word == known.word;
        if (!is_free(j) || found_[j].side != known.side || found_[j].bone != known.bone ||
            (known.bone == Bone::other && !same_word))
          continue;
        best = j;
        if (same_word) break;
      }
      if (best < found_.size()) set(i, best);
    }
  }

  // A root with another name is the joint that carries all others.
  void match_root() {
    if (mapped_.settled[0] != 0) return;
    const NamedTree tree{found_, skeleton_.parents};
    std::int32_t common = -1;
    for (const std::int32_t joint : mapped_.tracks) {
      if (joint >= 0) common = common < 0 ? joint : tree.common_ancestor(common, joint);
    }
    while (common >= 0 && !is_free(static_cast<std::size_t>(common)))
      common = skeleton_.parents[static_cast<std::size_t>(common)];
    if (common >= 0) set(0, static_cast<std::size_t>(common));
  }

  // A track between matched tracks is the joint between theirs, if each side has exactly one.
  void match_between() {
    for (std::size_t i = 1; i < layout_.track_count(); ++i) {
      const auto parent = static_cast<std::size_t>(layout_.parents[i]);
      if (mapped_.settled[i] != 0 || mapped_.tracks[parent] < 0) continue;
      std::vector<std::int32_t> between;
      bool all = true;
      for (std::size_t child = i + 1; all && child < layout_.track_count(); ++child) {
        if (layout_.parents[child] != static_cast<std::int32_t>(i)) continue;
        const auto path = free_joints(mapped_.tracks[parent], mapped_.tracks[child]);
        all = path.size() == 1 && (between.empty() || between == path);
        between = path;
      }
      if (all && between.size() == 1) set(i, static_cast<std::size_t>(between.front()));
    }
  }

  // Returns the joints above `bottom` and below `top` that are not tracks yet.
  std::vector<std::int32_t> free_joints(std::int32_t top, std::int32_t bottom) const {
    std::vector<std::int32_t> joints;
    if (bottom < 0) return joints;
    for (std::int32_t j = skeleton_.parents[static_cast<std::size_t>(bottom)]; j >= 0 && j != top;
         j = skeleton_.parents[static_cast<std::size_t>(j)]) {
      if (is_free(static_cast<std::size_t>(j))) joints.push_back(j);
    }
    return joints;
  }

  std::int32_t track_of(std::int32_t joint) const {
    const auto found = std::find(mapped_.tracks.begin(), mapped_.tracks.end(), joint);
    return found == mapped_.tracks.end()
               ? -1
               : static_cast<std::int32_t>(found - mapped_.tracks.begin());
  }

  // Returns the track that a track's joint is attached to in the take.
  std::int32_t track_above(std::size_t track) const {
    std::int32_t joint = mapped_.tracks[track];
    do {
      joint = skeleton_.parents[static_cast<std::size_t>(joint)];
    } while (joint >= 0 && track_of(joint) < 0);
    return joint < 0 ? -1 : track_of(joint);
  }

  // Releases joints that are not attached to the same track as in the layout, from the root
  // outward.
  void drop_misplaced() {
    for (std::size_t i = 0; i < layout_.track_count(); ++i) {
      if (mapped_.tracks[i] < 0 || track_above(i) == matched_parent(layout_, mapped_.tracks, i))
        continue;
      mapped_.used[static_cast<std::size_t>(mapped_.tracks[i])] = 0;
      mapped_.tracks[i] = -1;
      i = 0;
    }
  }

  const BodyLayout& layout_;
  const Skeleton& skeleton_;
  std::vector<std::uint8_t> turning_;
  MappedTracks mapped_;
  std::vector<BoneName> known_, found_;
};

// A matched joint is the bone of its track, whatever its name.
std::vector<BoneName> bones_of(const BodyLayout& layout, const Take& clip,
                               const std::vector<std::int32_t>& tracks) {
  std::vector<BoneName> bones = bone_names(clip.skeleton.names);
  const std::vector<BoneName> known = bone_names(layout.names);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i] < 0 || known[i].bone == Bone::other) continue;
    for (BoneName& bone : bones) {
      if (bone.bone == known[i].bone && bone.side == known[i].side) bone.bone = Bone::other;
    }
    bones[static_cast<std::size_t>(tracks[i])] = known[i];
  }
  return bones;
}

std::vector<std::int32_t> feet_of(const std::vector<BoneName>& bones) {
  std::vector<std::int32_t> feet;
  for (const Side side : {Side::left, Side::right}) {
    const std::int32_t foot = find_bone(bones, Bone::foot, side);
    if (foot >= 0) feet.push_back(foot);
  }
  return feet;
}

}  // namespace

std::vector<std::int32_t> match_joints(const BodyLayout& layout, const Take& clip,
                                       const NameMap& map) {
  return JointMatcher(layout, clip, map).match();
}

BodyMatch match_body_of_joints(const BodyLayout& layout, const Take& clip, const NameMap& names) {
  check_kind(layout, BodyKind::joints);
  BodyMatch match;
  match.tracks = match_joints(layout, clip, names);
  list_unmatched(layout, clip.skeleton.names, possible_tracks(clip), match);
  const std::vector<BoneName> bones = bones_of(layout, clip, match.tracks);
  const RestPose rest = rest_pose(clip, bones);
  match.upright = upright_world(clip, bones, rest);
  match.body_height = body_height_from_legs(clip.skeleton, bones);
  match.feet = feet_of(bones);
  align_joints(layout, clip, rest, match);
  return match;
}

}  // namespace kinemend::representation
