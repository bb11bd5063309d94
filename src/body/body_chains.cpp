// Finds trunk and neck by the limbs attached to them, or by their names.
#include "body/body_chains.hpp"

#include <algorithm>

#include "body/body_rest.hpp"

namespace kinemend::representation {

namespace {

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

}  // namespace

bool NamedTree::is_above(std::int32_t ancestor, std::int32_t joint) const {
  while (joint >= 0 && joint != ancestor) joint = parents[static_cast<std::size_t>(joint)];
  return joint >= 0;
}

std::int32_t NamedTree::common_ancestor(std::int32_t a, std::int32_t b) const {
  if (b < 0) return -1;
  while (a >= 0 && !is_above(a, b)) a = parents[static_cast<std::size_t>(a)];
  return a;
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

BodyChains chains_by_name(const std::vector<BoneName>& bones) {
  BodyChains chains;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (bones[i].bone == Bone::spine) chains.trunk.push_back(i);
    if (bones[i].bone == Bone::neck) chains.neck.push_back(i);
  }
  return chains;
}

}  // namespace kinemend::representation
