// Decides what becomes of repaired samples where cleaning goes only part of the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// What the input of a sample is worth.
enum class Evidence : std::uint8_t {
  measured,
  repaired,  ///< measured, but the cleaner put something else in its place
  missing
};

/// `observed` and `stated` may be empty: all observed, nothing in particular stated.
std::vector<Evidence> evidence_of(std::size_t frames, const std::vector<std::uint8_t>& observed,
                                  const std::vector<Action>& stated);

/// A repaired sample has no input of its own to go halfway from, so it stands off its cleaned value
/// as its neighbours do: on the straight line between the mean residuals (from the cleaned value to
/// the input) of the eight nearest measured samples on either side, or at that of the only side
/// there is. Of white noise little is left in such a mean; a bend that smoothing cuts, or a foot
/// that is moved, is all in it. `residual(f)` is asked for measured samples only. One vector a
/// frame, zero where nothing was repaired; empty where nothing was at all.
std::vector<Vec3> residuals_of_repaired(const std::vector<Evidence>& evidence,
                                        const std::function<Vec3(std::size_t)>& residual);

}  // namespace kinemend
