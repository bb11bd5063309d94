#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "fill/samples.hpp"

// The ways to fill a gap of one marker, one file each.
namespace kinemend::fill {

/// What is asked of a method.
struct MarkerRequest {
  std::size_t donor = no_marker;  ///< of `pattern`
  double longest_gap_s = 0;       ///< 0: what the method's rules say
  bool lenient = false;           ///< also what the rules refuse, as far as it is possible at all

  static constexpr std::size_t no_marker = std::numeric_limits<std::size_t>::max();
};

/// What a method makes of a gap.
struct Filling {
  std::vector<Vec3> positions;  ///< of the span's frames; empty: refused
  std::string method = {};      ///< that made them
  std::string reason = {};      ///< why it was refused
  double expected_error = 0;    ///< root mean square distance to the truth, file units; 0: unknown
  /// Refused for what other markers lack now; a later round may see more.
  bool may_wait = false;
  /// Made from what other markers show, so that it tells others something in turn; a curve does
  /// not.
  bool is_evidence = true;

  static Filling refused(std::string_view method, std::string reason) {
    return {{}, std::string(method), std::move(reason)};
  }
};

using FillMarkerGap = Filling (*)(const Samples& samples, const MarkerGap& gap,
                                  const MarkerRequest& request);

Filling fill_by_spline(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_quintic(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_pchip(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_hermite(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_pattern(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap,
                           const MarkerRequest& request);
Filling fill_by_pca(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap,
                                 const MarkerRequest& request);
Filling fill_by_cycles(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);
Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request);

/// The curve through the marker's own samples, at the span's frames; empty where it has none.
std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve);
/// The guess of the span's frames and those beside it, moved so that it meets the ends.
std::vector<Vec3> meet_ends(const Samples& samples, const MarkerGap& gap, std::size_t first_frame,
                            const std::vector<Vec3>& guess);

/// Markers of one segment keep their distance to within this share of the body's radius (standard
/// deviation).
inline constexpr double segment_spread = 0.02;

/// Spans in which the gap's marker is seen, for trying a method (`trial_places`); those of a gap at
/// an end of the take are tried as if the take ended with them. `helpers` are seen in all of them.
std::vector<MarkerGap> trial_gaps(const Samples& samples, const MarkerGap& gap,
                                  std::span<const std::size_t> helpers);

}  // namespace kinemend::fill
