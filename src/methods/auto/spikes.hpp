// Detects spikes in tracks and replaces them. Outliers that are so dense that they hide each other
// are the first candidates of their track.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "kinemend/extend/rotation.hpp"
#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

struct DetectedSpikes {
  SampleMarks marked;
  std::vector<double> noise;  ///< per track without its spikes, degrees
};

/// Detects spikes. Each sample is predicted from the other samples of its track by a robust
/// smoother; samples with the largest error of their neighbourhood become candidates, and the
/// smoother is fitted again without them until the candidates no longer change (`classify_spikes`
/// then decides). `nearby[n]` are the tracks that move with track n; `missing` samples are bridged
/// gaps, none of which is a spike. Spikes in `tracks` are interpolated linearly, and so are bridges
/// that start or end at one. `progress`, if any, advances to 0.4.
DetectedSpikes find_spikes(VectorTracks& tracks, const SampleMarks& initial_candidates,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const SampleMarks* missing = nullptr,
                           ShareProgress* progress = nullptr, const TrackTuning& tuning = {});

/// Outliers of a track (F vectors, degrees) that are more than 4 % of it, and at least five. A
/// running median starts a curve that most samples agree with; local quadratics with Welsch's
/// weights, on the scale of the samples close to it, refine the curve. Samples far from the curve
/// that agree with neither neighbour are outliers. `missing` samples (F marks; may be empty) have
/// no weight and are not marked. Returns F marks, or an empty vector if the track has fewer
/// outliers: `find_spikes` then finds them one by one.
std::vector<std::uint8_t> dense_outliers(std::span<const Vec3> track,
                                         std::span<const std::uint8_t> missing,
                                         double frame_rate_hz, const DenseTuning& tuning = {});

}  // namespace kinemend
