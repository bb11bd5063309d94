// Damages sequences of a body's channels, for trainings that learn from known faults.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/lab/corrupt.hpp"

namespace kinemend {

/// Damages a sequence of a body's channels in place, as `apply_damage` does: joints turn, place and
/// markers move. `observed` (F x N tracks, with `with_place` one more; empty: all) becomes 0 at
/// lost samples. `joints` of a damage names tracks; the place is `place`, a root like the first
/// joint. The same generator gives the same bytes, so that each sequence forks its own. Errors: as
/// of `apply_damage`; lengths are unknown, so `position-noise` requires `cm_per_unit`.
DamageReport damage_sequence(const BodyLayout& layout, double rate_hz, PoseMatrix& poses,
                             std::vector<std::uint8_t>& observed, std::string_view name,
                             const OptionValues& values, Random& random);

/// Interpolates lost samples linearly between the others; `observed` as above.
void bridge_lost(PoseMatrix& poses, const std::vector<std::uint8_t>& observed);

/// Draws evenly in the logarithm, as for strengths and frequencies.
double log_uniform(Random& random, double low, double high);

}  // namespace kinemend
