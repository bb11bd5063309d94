// Turns the degrees of freedom of ASF into the channels of a joint.
#include <algorithm>
#include <utility>

#include "io/acclaim/asf.hpp"

namespace kinemend {

namespace {

bool turns(const AsfDof& dof) { return dof && is_rotation(*dof); }

}  // namespace

std::vector<std::optional<std::size_t>> channel_slots(const std::vector<AsfDof>& dofs) {
  std::vector<std::optional<std::size_t>> slots(dofs.size());
  std::vector<std::size_t> rotations;
  std::size_t next = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (!dofs[i]) continue;
    if (turns(dofs[i])) rotations.push_back(i);
    slots[i] = next++;
  }
  for (std::size_t i = 0; i < rotations.size() / 2; ++i) {
    std::swap(slots[rotations[i]], slots[rotations[rotations.size() - 1 - i]]);
  }
  return slots;
}

std::vector<Channel> channels_of(const std::vector<AsfDof>& dofs) {
  const auto slots = channel_slots(dofs);
  std::vector<Channel> channels(static_cast<std::size_t>(
      std::count_if(dofs.begin(), dofs.end(), [](const AsfDof& dof) { return dof.has_value(); })));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (slots[i]) channels[*slots[i]] = *dofs[i];
  }
  return channels;
}

}  // namespace kinemend
