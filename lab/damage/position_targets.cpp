// Chooses the joints with damaged positions, finds the length of a unit, and calls the refit.
#include "lab/damage/position_targets.hpp"

#include <fmt/format.h>

#include "kinemend/extend/motion.hpp"
#include "lab/damage/refit.hpp"

namespace kinemend::corrupt {

std::vector<std::size_t> position_joints(const Skeleton& skeleton, const TargetOptions& options) {
  // Every joint has a position, even without channels.
  Skeleton bare = skeleton;
  for (auto& channels : bare.channels) channels.clear();
  return target_joints(bare, options);
}

void refit_to(Take& clip, std::span<const Vec3> targets, const TargetOptions& options) {
  std::vector<std::uint8_t> may_turn(clip.joint_count(), 0);
  TargetOptions all_joints;
  all_joints.root = options.root;
  for (const std::size_t j : target_joints(clip.skeleton, all_joints)) may_turn[j] = 1;
  refit(clip, targets, may_turn, options.root);
}

double usual_cm_per_unit(const Skeleton& skeleton, Notes& notes) {
  const double height = body_height(skeleton);
  double scale = height > 0 ? usual_height_cm / height : 1.0;
  if (const auto unit = guess_length_unit(skeleton)) scale = 100 * unit->metres;
  notes.push_back(fmt::format("a file unit is taken as {:.4g} cm", scale));
  return scale;
}

}  // namespace kinemend::corrupt
