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

  /// Returns the nearest joint above both, or the one of them that is above the other; -1: none.
  std::int32_t common_ancestor(std::int32_t a, std::int32_t b) const;
  bool is_above(std::int32_t ancestor, std::int32_t joint) const;
};

/// The joints from the hips to the joint that carries the arms (included), and those from there to
/// the head, bottom up. They are found by the limbs attached to them, because files name them in
/// many ways. Both are empty if pelvis, arms or head are not found.
struct BodyChains {
  std::vector<std::size_t> trunk, neck;
};
BodyChains chains_by_topology(const NamedTree& tree);
/// Finds the chains by the names of their joints.
BodyChains chains_by_name(const std::vector<BoneName>& bones);

}  // namespace kinemend::representation
