#pragma once

#include <cstdint>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend {

/// What the method `auto` makes of a body's channels, for the training of what corrects it.
struct AutoChannels {
  PoseMatrix poses;                   ///< F x D
  std::vector<std::uint8_t> suspect;  ///< F x D, 1 where a sample is taken for a spike
  std::vector<double> noise;          ///< D, degrees
};

/// `observed`: F x N tracks, with the place one more; empty: all. Missing samples of `poses` hold
/// bridges. Turns are cleaned in their charts, as `auto` cleans a take's.
AutoChannels auto_of_channels(const BodyLayout& layout, double rate_hz, const PoseMatrix& poses,
                              const std::vector<std::uint8_t>& observed);

}  // namespace kinemend
