// Finds the joints of trunk and neck, which files name in many ways.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_names.hpp"

namespace kinemend::representation {

/// A tree of named joints, of a skeleton or of a layout.
struct NamedTree {
  const std::vector<BoneName>& bones;
  const std::vector<std::int32_t>& parents;  ///< -1 for a root

  /// The nearest joint above both (or one of them, where it is above the other); -1: none.
  std::int32_t common_ancestor(std::int32_t a, std::int32_t b) const;
  bool is_above(std::int32_t ancestor, std::int32_t joint) const;
};

/// The joints between the hips and the arms, the one that carries the arms included, and those
/// between it and the head; from below. They are told by what hangs on them: files give them any
/// number of names. Both are empty where pelvis, arms or head are not found.
struct BodyChains {
  std::vector<std::size_t> trunk, neck;
};
BodyChains chains_by_topology(const NamedTree& tree);
/// The same by their own names.
BodyChains chains_by_name(const std::vector<BoneName>& bones);

}  // namespace kinemend::representation
