// Finds the limb of a joint or a marker from its name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::corrupt {

/// The part of a body in the name of a joint or marker: `LeftForeArm`, `Ann:LWRA`, `Right_Heel`,
/// `kneeL`.
enum class NamedPart : std::uint8_t { other, arm, leg };
NamedPart named_part(std::string_view name);

/// Returns the limb of each name as consecutive numbers: arms and legs of either side, and all
/// others as one.
std::vector<std::size_t> named_limbs(const std::vector<std::string>& names);

/// Returns wrists and ankles by their names (`hand`, `wrist`, `foot`, `ankle`; not fingers and
/// toes).
std::vector<std::size_t> wrists_and_ankles(const std::vector<std::string>& names);

}  // namespace kinemend::corrupt
