// Recognises missing samples of joints, which formats without gaps mark by NaN, and holds the last
// known sample of a joint or marker.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

inline bool is_missing(Vec3 v) { return std::isnan(v.x + v.y + v.z); }
inline bool is_missing(Quat q) { return std::isnan(q.w); }

/// Returns the unit rotation of four values of a file; NaN if one is missing or all are zero.
inline Quat rotation_of_values(double w, double x, double y, double z) {
  const Quat raw{w, x, y, z};
  const double length = norm(raw);
  if (!(length > 0) || !std::isfinite(length)) {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    return {missing, missing, missing, missing};
  }
  // A quaternion that is already of unit norm keeps its digits.
  constexpr double tolerance = 1e-12;
  return std::fabs(length - 1) <= tolerance ? raw : normalized(raw);
}

/// A quaternion whose length differs from 1 by more than this is not just rounded; scaling it is a
/// repair.
inline constexpr double unit_length_tolerance = 1e-3;

/// Replaces each missing sample of a track by the last one before it. Missing samples at the start
/// get the first sample; a track without samples gets `otherwise`.
template <class Sample>
void hold_missing(std::vector<Sample>& samples, std::size_t track, std::size_t stride,
                  Sample otherwise) {
  const Sample* last = nullptr;
  for (std::size_t i = track; i < samples.size(); i += stride) {
    if (!is_missing(samples[i])) {
      if (last == nullptr) {
        for (std::size_t k = track; k < i; k += stride) samples[k] = samples[i];
      }
      last = &samples[i];
    } else if (last != nullptr) {
      samples[i] = *last;
    }
  }
  for (std::size_t i = track; i < samples.size() && last == nullptr; i += stride)
    samples[i] = otherwise;
}

/// Returns the F positions of a marker; a missing one is the last known position before it, or the
/// first known one; all are zero if none is known.
inline std::vector<Vec3> held_positions(const Take& take, std::size_t marker) {
  std::vector<Vec3> track(take.frame_count());
  std::size_t known = 0;
  while (known < track.size() && !take.is_observed(known, marker)) ++known;
  if (known == track.size()) return track;
  Vec3 last = take.position(known, marker);
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (take.is_observed(f, marker)) last = take.position(f, marker);
    track[f] = last;
  }
  return track;
}

}  // namespace kinemend
