// Measures how much of a noise is visible in the distances between tracks, which motion hardly
// changes.
#pragma once

#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// How much of a noise is visible in the distances between tracks, from 0 (none) to about 1 (all):
/// noise moves the markers of one segment against each other, motion does not. For each track with
/// noise: the change of its distance to another from frame to frame, relative to the change that
/// independent noise of these `deviations` (N, of each axis) and this `correlation` from frame to
/// frame would cause; the least over the other tracks. Returns the median over the tracks. `marked`
/// samples are ignored. 0 if no two tracks are seen together.
double noise_in_distances(const VectorTracks& tracks, const SampleMarks& marked,
                          const std::vector<Vec3>& deviations, double correlation);

}  // namespace kinemend
