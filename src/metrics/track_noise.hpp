// Estimates the white noise of a track from its second differences.
#pragma once

#include <cstddef>
#include <span>

#include "base/quantiles.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// Returns the standard deviation per axis of the white noise on a track (radians; the points'
/// unit), from the median length of its second differences: motion hardly bends within three
/// frames, and outliers do not affect a median. Uses at most `most_samples`, evenly spread. Returns
/// 0 for fewer than 3 samples.
double track_noise(std::span<const Quat> track, std::size_t most_samples = 4096);
double track_noise(std::span<const Vec3> track, std::size_t most_samples = 4096);

/// Returns the length of the second difference of three successive samples (radians or the points'
/// unit).
double second_difference(Quat a, Quat b, Quat c);
double second_difference(Vec3 a, Vec3 b, Vec3 c);
/// Noise per axis divided by the median second difference. By definition: the root of 1 + 4 + 1.
inline constexpr double noise_per_second_difference = 1 / (median_of_chi3 * 2.449489742783178);

}  // namespace kinemend
