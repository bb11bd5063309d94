// Measures the noise and the spikes of a take, for the reports of every method.
#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/take_view.hpp"

namespace kinemend {

/// The noise and spikes that `auto` finds in a take at its default options, ignoring any known
/// noise: the same figures for every method that cleans the take.
struct MeasuredNoise {
  /// One per track: per axis, degrees or file units; 0 for tracks that may not change. Empty: the
  /// take is too short.
  std::vector<double> noise;
  std::vector<ColouredNoise> coloured;            ///< one per track, if coloured
  std::vector<std::vector<std::uint8_t>> spikes;  ///< one per track: F, or empty for none
  std::vector<NoiseCharacter> characters;  ///< at most one for rotations and one for positions
};
MeasuredNoise measure_noise(const TakeView& take);

}  // namespace kinemend
