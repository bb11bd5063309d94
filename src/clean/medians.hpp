#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"

// Medians of rotations and of points. Rotations are measured by the chord of their quaternions,
// 2 |a - b| = 4 sin(angle / 4): within 0.3 % of the angle up to 30 degrees, the same in every
// coordinate frame, and indifferent to signs.
namespace kinemend {

/// Chordal distance of two rotations, radians (for small ones): 4 sin(angle / 4).
double chord(Quat a, Quat b);
inline double chord(Vec3 a, Vec3 b) { return norm(a - b); }

/// Room for the medians' sums, so that a run over many windows allocates once.
struct MedianScratch {
  std::vector<double> coordinates;
  std::vector<double> distances;
};

/// Index of the sample with the least sum of distances to all (the first of equals). Not empty.
std::size_t medoid(std::span<const Quat> samples, MedianScratch& scratch);
std::size_t medoid(std::span<const Vec3> samples, MedianScratch& scratch);

/// The point with the least sum of distances to the samples, by Weiszfeld's iteration from the
/// medoid with the step of Vardi & Zhang 2000 where a sample is met; rotations are projected back
/// to the sphere. To 1e-9 of the spread. Not empty.
Quat l1_median(std::span<const Quat> samples, MedianScratch& scratch);
Vec3 l1_median(std::span<const Vec3> samples, MedianScratch& scratch);

}  // namespace kinemend
