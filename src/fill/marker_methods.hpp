// The ways to fill a gap of one marker.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "fill/curves.hpp"
#include "fill/samples.hpp"
#include "fill/track.hpp"

namespace kinemend::fill {

/// The options of a request to one method.
struct MarkerRequest {
  std::size_t donor = no_marker;  ///< used by `pattern`
  double longest_gap_s = 0;       ///< 0: the limit of the method's rules
  bool lenient = false;           ///< also fills gaps that the rules refuse, if a method can

  static constexpr std::size_t no_marker = std::numeric_limits<std::size_t>::max();
};

using FillMarkerGap = Filling (*)(const Samples& samples, const MarkerGap& gap,
                                  const MarkerRequest& request);

Filling fill_by_pattern(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap,
                           const MarkerRequest& request);
Filling fill_by_pca(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap,
                                 const MarkerRequest& request);
Filling fill_marker_by_cycles(const Samples& samples, const MarkerGap& gap,
                              const MarkerRequest& request);
Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
/// The longest gap that a curve fills by its own rule, and in which `auto` tries one. Not swept.
inline constexpr double longest_curve_s = 0.25;
/// Fills by a curve through the marker's own samples; `name` is the method's.
Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request,
                      Curve curve, std::string_view name);

/// Returns the curve through the marker's own samples at the span's frames; empty if it has none.
std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve);

/// Markers of one segment keep their distance to within this share of the body's radius (standard
/// deviation). Chosen on the takes that docs/measured/fill.md names.
inline constexpr double segment_spread = 0.02;
/// The number of other markers that a regression needs to know the body's rotation.
inline constexpr std::size_t least_companions = 3;

}  // namespace kinemend::fill
