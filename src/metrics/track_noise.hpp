// Estimates the white noise of a track from its second differences.
#pragma once

#include <cstddef>
#include <span>

#include "base/quantiles.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// Standard deviation per axis of the white noise on a track (radians; the points' unit), from the
/// median length of its second differences: motion hardly bends within three frames, and what is
/// thrown far off does not count. Looks at no more than `most_samples`, evenly spread. 0 for fewer
/// than 3 samples.
double track_noise(std::span<const Quat> track, std::size_t most_samples = 4096);
double track_noise(std::span<const Vec3> track, std::size_t most_samples = 4096);

/// Length of the second difference of three successive samples, and the noise per axis (radians or
/// the points' unit) of which it would be the median.
double second_difference(Quat a, Quat b, Quat c);
double second_difference(Vec3 a, Vec3 b, Vec3 c);
/// Noise per axis divided by the median second difference. By definition: the root of 1 + 4 + 1.
inline constexpr double noise_per_second_difference = 1 / (median_of_chi3 * 2.449489742783178);

}  // namespace kinemend
