#pragma once

#include <cstdint>
#include <span>

#include "kinemend/pose_matrix.hpp"

namespace kinemend {

/// Smooths channels in place as `auto` smooths tracks, each three of them one track: by nothing but
/// their own evidence. `missing` is F x D, 1 where a sample has no weight; `noise` D, standard
/// deviations, degrees, all above 0. Three channels with fewer than 16 frames stay as they are.
void smooth_channels(PoseMatrix& poses, std::span<const std::uint8_t> missing,
                     std::span<const double> noise, double frame_rate_hz);

}  // namespace kinemend
