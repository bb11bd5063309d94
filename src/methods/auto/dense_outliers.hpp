// Finds outliers that are so dense that they hide each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"
#include "methods/auto/tuning.hpp"

namespace kinemend {

/// Outliers of a track (F vectors, degrees) that are more than 4 % of it, and at least five. A
/// running median starts a curve that most samples agree with; local quadratics with Welsch's
/// weights, on the scale of the samples close to it, refine the curve. Samples far from the curve
/// that agree with neither neighbour are outliers. `missing` samples (F marks; may be empty) have
/// no weight and are not marked. Returns F marks, or an empty vector if the track has fewer
/// outliers: `find_spikes` then finds them one by one.
std::vector<std::uint8_t> dense_outliers(std::span<const Vec3> track,
                                         std::span<const std::uint8_t> missing,
                                         double frame_rate_hz, const DenseTuning& tuning = {});

}  // namespace kinemend
