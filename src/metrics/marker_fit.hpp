// Pairs the markers of two takes, and fits those of one to those of the other.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/metrics.hpp"

namespace kinemend::metrics {

/// Markers that two takes share, with a lag in time.
struct MarkerPair {
  const Take& reference;
  const Take& other;
  std::vector<std::size_t> reference_markers, other_markers;  ///< the same length
  std::size_t first_frame = 0;  ///< first compared frame of the reference
  std::size_t frames = 0;
  std::ptrdiff_t lag = 0;  ///< frame f of the reference is f + lag of the other
  double scale = 1;        ///< factor of the other's lengths

  std::size_t markers() const { return reference_markers.size(); }
  bool is_seen(std::size_t frame, std::size_t marker) const;
  Vec3 reference_at(std::size_t frame, std::size_t marker) const;  ///< frames count from 0
  Vec3 other_at(std::size_t frame, std::size_t marker) const;
};

/// Throws as `compare_markers` does.
MarkerPair pair_markers(const Take& reference, const Take& other, std::ptrdiff_t lag_frames);

/// The fit of one marker from the reference to the other system: p' = turn p + shift, or gain p +
/// shift along each axis.
struct FittedMarker {
  Quat turn{1, 0, 0, 0};
  Vec3 gain{1, 1, 1};
  Vec3 shift;

  Vec3 operator()(Vec3 p) const;
};
/// Fits by least squares over the samples that both takes have. A marker that is never seen in both
/// is not moved; a constant channel gets an offset only.
std::vector<FittedMarker> fit_markers(const MarkerPair& pair, MarkerFit fit);

}  // namespace kinemend::metrics
