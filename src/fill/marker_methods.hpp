// The ways to fill a gap of one marker.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "fill/curves.hpp"
#include "fill/filling.hpp"
#include "fill/samples.hpp"

namespace kinemend::fill {

/// What is asked of a method.
struct MarkerRequest {
  std::size_t donor = no_marker;  ///< of `pattern`
  double longest_gap_s = 0;       ///< 0: what the method's rules say
  bool lenient = false;           ///< also what the rules refuse, as far as it is possible at all

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
/// By a curve through the marker's own samples, of the method `name`.
Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request,
                      Curve curve, std::string_view name);

/// The curve through the marker's own samples, at the span's frames; empty where it has none.
std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve);

/// Markers of one segment keep their distance to within this share of the body's radius (standard
/// deviation). Chosen on the takes that docs/methods/fill.md names.
inline constexpr double segment_spread = 0.02;
/// Other markers that a regression needs: they tell how the body turns.
inline constexpr std::size_t least_companions = 3;

}  // namespace kinemend::fill
