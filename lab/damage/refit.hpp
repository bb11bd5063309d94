// Turns the joints of a clip to fit given positions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::corrupt {

/// Returns the rotation R near `clean` that turns `from[i]` (the joint's frame) towards `to[i]`
/// (world), minimising sum_i |to_i - R from_i|^2. For one vector: `clean` followed by the smallest
/// turn that aligns it, so that the twist is kept. For several: Davenport's solution of Wahba's
/// problem, with a small weight (1e-4) of `clean`, which determines R where they do not. Returns
/// `clean` if no vector has a length.
Quat fit_rotation(Quat clean, std::span<const Vec3> from, std::span<const Vec3> to);

/// Turns joints so that joint positions are as near to `targets` (F x J, world) as rigid bones
/// allow, from the roots down: each joint with children at a distance points them at their targets.
/// Bone lengths and translations are kept. Joints with `may_turn` 0, those without such children,
/// and those whose rotation is right to 1e-9 rad are unchanged. `move_root` puts joint 0 at its
/// target.
void refit(Take& clip, std::span<const Vec3> targets, std::span<const std::uint8_t> may_turn,
           bool move_root);

}  // namespace kinemend::corrupt
