// Tells from the name of a joint or a marker which limb it belongs to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::corrupt {

/// What a joint's or marker's name says about its place on a body: `LeftForeArm`, `Ann:LWRA`,
/// `Right_Heel`, `kneeL`.
enum class NamedPart : std::uint8_t { other, arm, leg };
NamedPart named_part(std::string_view name);

/// The limb of each name as consecutive numbers: arms and legs of either side, and the rest as one.
std::vector<std::size_t> named_limbs(const std::vector<std::string>& names);

/// Wrists and ankles, by their names (`hand`, `wrist`, `foot`, `ankle`; not fingers and toes).
std::vector<std::size_t> wrists_and_ankles(const std::vector<std::string>& names);

}  // namespace kinemend::corrupt
