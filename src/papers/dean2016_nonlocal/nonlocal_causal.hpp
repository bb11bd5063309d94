// Non-local pose means of past frames only, for live streams.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "kinemend/cleaner.hpp"

namespace kinemend {

/// Non-local pose means of the past only: patches end at their pose, and only earlier poses are
/// averaged.
struct CausalNonlocalSettings {
  std::size_t window = 20;     ///< earlier poses
  std::size_t patch = 11;      ///< poses of a patch
  std::size_t neighbours = 0;  ///< only the most similar patches; 0: all of the window
  /// The paper's sigma, radians; 0: `noise_share` times the noise measured in the frames so far.
  double bandwidth = 0;
  double noise_share = 0.8;  ///< chosen by hand (docs/methods/nonlocal.md); no sweep is stored
};

/// `joints`: those that belong to the pose. The root position is unchanged: earlier places of a
/// body do not determine its present one.
std::unique_ptr<LiveFilter> make_causal_nonlocal(const CausalNonlocalSettings& settings,
                                                 std::vector<std::size_t> joints);

}  // namespace kinemend
