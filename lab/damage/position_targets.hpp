// The joints that damage of positions affects, and the refit of the pose to the positions.
#pragma once

#include <span>
#include <vector>

#include "lab/damage/damage_kind.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

/// Returns the joints whose positions are damaged: the selected ones, joint 0 only with `root`.
/// Their rotation channels do not matter, because the joints above them turn.
std::vector<std::size_t> position_joints(const Skeleton& skeleton, const TargetOptions& options);

/// Refits the clip to damaged positions; roots turn and move only with `root`.
void refit_to(Take& clip, std::span<const Vec3> targets, const TargetOptions& options);

/// Returns the length of a file unit if none is given: the usual unit in which the skeleton has
/// human size, otherwise the one that makes it 170 cm tall. Adds a note of it.
double usual_cm_per_unit(const Skeleton& skeleton, Notes& notes);

}  // namespace kinemend::corrupt
