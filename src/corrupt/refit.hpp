// Turns the joints of a clip so that they come near to given positions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::corrupt {

/// The rotation R nearest to `clean` that turns `from[i]` (the joint's frame) towards `to[i]`
/// (world), minimising sum_i |to_i - R from_i|^2. One vector: `clean` followed by the smallest turn
/// that aligns, so that the twist stays. Several: Davenport's solution of Wahba's problem, with a
/// small weight (1e-4) of `clean`, which determines R where they do not. `clean` when no vector has
/// a length.
Quat fit_rotation(Quat clean, std::span<const Vec3> from, std::span<const Vec3> to);

/// Turns joints so that joint positions are as near to `targets` (F x J, world) as rigid bones
/// allow, from the roots down: each joint whose children are away from it points them at their
/// targets. Bone lengths and translations stay. Joints of which `may_turn` is 0, those without such
/// children, and joints whose rotation is right to 1e-9 rad keep theirs to the bit. `move_root`
/// puts joint 0 at its target.
void refit(Take& clip, std::span<const Vec3> targets, std::span<const std::uint8_t> may_turn,
           bool move_root);

}  // namespace kinemend::corrupt
