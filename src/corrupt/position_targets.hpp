#pragma once

#include <string_view>
#include <vector>

#include "corrupt/targets.hpp"

namespace kinemend::corrupt {

/// Joints whose positions are damaged: those asked for, joint 0 only with `root`. Their rotation
/// channels do not matter: it is the joints above them that turn.
std::vector<std::size_t> position_joints(const Skeleton& skeleton, const TargetOptions& options);

/// Refits the clip to damaged positions; roots turn and move with `root` only.
void refit_to(Clip& clip, std::span<const Vec3> targets, const TargetOptions& options);

/// Wrists and ankles, by their names (`hand`, `wrist`, `foot`, `ankle`; not fingers and toes).
std::vector<std::size_t> wrists_and_ankles(const std::vector<std::string>& names);

}  // namespace kinemend::corrupt
