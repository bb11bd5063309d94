// The core of the method `auto`, on tracks of vectors in degrees.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/progress.hpp"
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
  std::optional<double> correlation{};  ///< of the noise, where it is known; 0: white
  std::vector<double> noise{};          ///< N, degrees, where it is known, else 0; empty: nowhere
  TrackTuning tuning = {};
  bool smooth = true;  ///< false: the noise and the spikes are found, and nothing is smoothed
};

struct CleanedTracks {
  SampleMarks marked;          ///< spikes
  std::vector<double> noise;   ///< of each track, degrees, as measured
  std::vector<double> shares;  ///< of smoothing, per track, 0 to 1
  SamplePattern pattern;       ///< which frames are measurements; noise is that of these
  NoiseSpectrum spectrum;      ///< the noise where it is not white
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
