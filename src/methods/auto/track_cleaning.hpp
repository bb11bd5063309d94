// The core of the method `auto`, on tracks of vectors in degrees.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "methods/auto/held_samples.hpp"
#include "methods/auto/noise_spectrum.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

/// Takes of fewer frames are not changed. A third difference, by which noise is measured, spans
/// four by definition.
inline constexpr std::size_t fewest_clean_frames = 4;

struct TrackCleaningSettings {
  double sensitivity = 1;  ///< scales the estimated noise
  bool despike = true;
  TrackKind kind = TrackKind::rotations;
  std::optional<double> correlation{};  ///< of the noise, if known; 0: white
  std::vector<double> noise{};          ///< N, degrees, 0 if unknown; empty: all unknown
  TrackTuning tuning = {};
  bool smooth = true;  ///< false: only finds the noise and the spikes
};

struct CleanedTracks {
  SampleMarks marked;          ///< spikes
  std::vector<double> noise;   ///< per track, degrees, as measured
  std::vector<double> shares;  ///< of smoothing, per track, 0 to 1
  SamplePattern pattern;       ///< the frames of measurements; noise is that of these
  NoiseSpectrum spectrum;      ///< the noise if it is not white
};

/// Interpolates spikes and smooths noise, in place. `spike_candidates` start the detection
/// (`find_spikes`); `always_missing` samples are bridged gaps; `nearby[n]` are the tracks that move
/// with track n. `progress`, if any, advances to 0.75.
CleanedTracks clean_tracks(VectorTracks& tracks, const SampleMarks& spike_candidates,
                           const SampleMarks& always_missing,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const TrackCleaningSettings& settings,
                           ShareProgress* progress = nullptr);

}  // namespace kinemend
