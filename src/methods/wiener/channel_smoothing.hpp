// Smooths channels of a body as `auto` smooths tracks; `wiener` mixes its own result with that.
#pragma once

#include <cstdint>
#include <span>

#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend {

/// Smooths channels in place as `auto` smooths tracks, each three of them one track, without a
/// learned model. `missing` is F x D, 1 for samples without weight; `noise` D, standard deviations,
/// degrees, all above 0. Tracks of fewer than 16 frames are not changed.
void smooth_channels(PoseMatrix& poses, std::span<const std::uint8_t> missing,
                     std::span<const double> noise, double frame_rate_hz);

}  // namespace kinemend
