// Measures how much of a noise shows in the distances between tracks, where motion hardly shows.
#pragma once

#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// How much of a noise the distances between tracks show, 0 for none and about 1 for all of it:
/// noise moves the markers of one segment against each other, motion does not. Of each track that
/// has noise, the change of its distance to another from frame to frame over what independent noise
/// of these `deviations` (N, of each axis) and this `correlation` from frame to frame would make of
/// it, to that other for which it is least; the median over the tracks. `marked` samples are not
/// looked at. 0 where no two tracks are seen together.
double noise_in_distances(const VectorTracks& tracks, const SampleMarks& marked,
                          const std::vector<Vec3>& deviations, double correlation);

}  // namespace kinemend
