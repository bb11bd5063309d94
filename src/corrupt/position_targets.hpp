// The joints that damage of positions reaches, and the way back from positions to a pose.
#pragma once

#include <span>
#include <vector>

#include "corrupt/damage_kind.hpp"
#include "corrupt/targets.hpp"

namespace kinemend::corrupt {

/// Joints whose positions are damaged: those asked for, joint 0 only with `root`. Their rotation
/// channels do not matter, as the joints above them turn.
std::vector<std::size_t> position_joints(const Skeleton& skeleton, const TargetOptions& options);

/// Refits the clip to damaged positions; roots turn and move with `root` only.
void refit_to(Take& clip, std::span<const Vec3> targets, const TargetOptions& options);

/// Length of a file unit where nobody says: the usual unit that makes the skeleton a person, else
/// such that it is 170 cm tall; with a note of it.
double usual_cm_per_unit(const Skeleton& skeleton, Notes& notes);

}  // namespace kinemend::corrupt
