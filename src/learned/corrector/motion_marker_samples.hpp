// Draws samples of markers for the training of the learned cleaner.
#pragma once

#include <cstddef>
#include <span>

#include "learned/corrector/motion_samples.hpp"

namespace kinemend {

/// A stretch of the markers of a body that travels, or of what is left of its motion when it is
/// held where its root is; damaged as optical systems, video and depth cameras damage markers, and
/// as pipelines filter them. As many channels as asked for, the last of them 0. The same `random`
/// gives the same sample.
MotionSample random_marker_sample(std::span<const MarkerMotion> markers, std::size_t channels,
                                  const MotionSampling& sampling, Random random);

}  // namespace kinemend
