// Computes the residuals of repaired samples for a clean of partial strength.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// How far the input of a sample can be trusted.
enum class Evidence : std::uint8_t {
  measured,
  repaired,  ///< measured, but replaced by the cleaner
  missing
};

/// `observed` and `stated` may be empty: all are observed, and no action is stated.
std::vector<Evidence> evidence_of(std::size_t frames, const std::vector<std::uint8_t>& observed,
                                  const std::vector<Action>& stated);

/// A repaired sample has no input of its own to blend with. It gets the residual (from the cleaned
/// value to the input) of its neighbours instead: on the straight line between the mean residuals
/// of the eight nearest measured samples on either side, or the mean of the only side that has any.
/// White noise nearly vanishes in such a mean; a bend that smoothing cuts, or a foot that is moved,
/// is kept. `residual(f)` is called for measured samples only. Returns one vector for each frame,
/// zero if it was not repaired; empty if no sample was repaired.
std::vector<Vec3> residuals_of_repaired(const std::vector<Evidence>& evidence,
                                        const std::function<Vec3(std::size_t)>& residual);

}  // namespace kinemend
