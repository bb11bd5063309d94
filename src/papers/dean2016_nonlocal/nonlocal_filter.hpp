// Computes non-local pose means of a whole take (Dean 2016), and the bandwidth of the least
// expected error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cleaner/pieces.hpp"

namespace kinemend {

/// Extension of the take beyond its first and last pose.
enum class NonlocalBoundary {
  mirror,    ///< x_-i = x_i
  neumann,   ///< the gradient is constant: the line through the first patch continues
  dirichlet  ///< the value is constant: x_-i = x_0
};

/// Non-local pose means (Dean 2016, eq. 3-4), in frames and radians.
struct NonlocalSettings {
  std::size_t window_radius = 10;
  bool whole_take = false;  ///< compares all poses of the take, none beyond its ends
  std::size_t patch_radius = 5;
  std::size_t neighbours = 0;  ///< number of most similar patches; 0: the whole window
  double bandwidth = 0;        ///< the paper's sigma, for the mean over a patch's channels
  /// Mean squared difference of two patches that differ by noise only; smaller differences are
  /// raised to it. A pose then has the weight of a neighbour at this distance. 0: the paper's
  /// weights.
  double noise_distance = 0;
  NonlocalBoundary boundary = NonlocalBoundary::neumann;
  std::size_t travel_radius =
      10;  ///< poses at a larger distance have no weight for the root position
};

/// The data of a take: joints, or points of a body. Tracks have the same number of
/// frames.
struct NonlocalTake {
  std::vector<RotationTrack> rotations;       ///< of every joint that belongs to the pose
  std::vector<std::vector<double>> observed;  ///< one per rotation track: `observed_weights`
  std::vector<std::uint8_t> wanted;           ///< one per rotation track: 1 if it may change
  std::vector<VectorTrack> positions;         ///< averaged with the same weights
  std::vector<std::uint8_t> travels;  ///< one per position track: 1 for the root's, in space
  /// All markers of the pose. Poses are compared and averaged about their own centre, which is
  /// averaged over the frames within `travel_radius`; nothing is rotated.
  std::vector<VectorTrack> points;
  std::vector<std::vector<double>> points_observed;  ///< one per point; empty: all observed

  std::size_t frames() const;
};

void nonlocal_filter(NonlocalTake& take, const NonlocalSettings& settings);

/// The bandwidth of the least expected error under white noise of `variance` per channel: of a grid
/// from 0.3 to 3.4 times the noise, the one with the least Mallows' C_p,
///   sum |filtered - given|^2 + 2 variance sum (weight of the sample itself),
/// over some hundred frames. (A patch has many channels, so that one sample's noise changes the
/// weights little and the filter is nearly linear in it.) `settings.noise_distance` is 2 variance.
double best_bandwidth(const NonlocalTake& take, const NonlocalSettings& settings, double variance);

}  // namespace kinemend
