// Medians of rotations and of points. The distance of rotations is the chord of their quaternions,
// 2 |a - b| = 4 sin(angle / 4): within 0.3 % of the angle up to 30 degrees, the same in every
// coordinate frame, and independent of signs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// Chordal distance of two rotations, radians (for small ones): 4 sin(angle / 4).
double chord(Quat a, Quat b);
inline double chord(Vec3 a, Vec3 b) { return norm(a - b); }

/// Index of the sample with the least sum of distances to all (the first of equals). `samples` must
/// not be empty.
std::size_t medoid(std::span<const Quat> samples);
std::size_t medoid(std::span<const Vec3> samples);
/// The same; `scratch` is reused between calls.
std::size_t medoid(std::span<const Quat> samples, std::vector<double>& scratch);
std::size_t medoid(std::span<const Vec3> samples, std::vector<double>& scratch);

/// The point with the least sum of distances to the samples, starting at sample `start` (their
/// medoid): `start` itself if that is the median, otherwise found by Newton's steps, or Weiszfeld's
/// if those increase the sum (Vardi & Zhang 2000), to 1e-6 of the mean distance. Rotations are
/// represented by the vectors 2 sin(angle / 2) about the medoid. `scratch` is reused between calls.
Quat l1_median(std::span<const Quat> samples, std::size_t start, std::vector<Vec3>& scratch);
Vec3 l1_median(std::span<const Vec3> samples, std::size_t start, std::vector<Vec3>& scratch);

/// The medoids of windows that move along a track; each distance is computed once. The results
/// equal `medoid` of each window.
template <class Sample>
class MovingMedoid {
 public:
  /// No window is longer than `longest`.
  MovingMedoid(std::span<const Sample> track, std::size_t longest);

  /// Frame of the medoid of the window [first, last]; neither decreases between calls.
  std::size_t find(std::size_t first, std::size_t last);
  /// Distance of two frames of the last window.
  double distance(std::size_t a, std::size_t b) const {
    return distances_[(a % longest_) * longest_ + b % longest_];
  }

 private:
  void take_in(std::size_t frame);

  std::span<const Sample> track_;
  std::size_t longest_;
  std::size_t next_ = 0;           // the first frame without distances
  std::size_t first_ = 0;          // of the window
  std::vector<double> distances_;  // longest x longest, frames modulo longest
  std::vector<double> sums_;
};

}  // namespace kinemend
