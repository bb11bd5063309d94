#pragma once

#include <cstddef>
#include <vector>

#include "base/progress.hpp"
#include "tracks/vector_tracks.hpp"

// What the method `auto` does with tracks of any kind, once they are vectors in degrees.
namespace kinemend {

/// Takes of fewer frames are left alone.
inline constexpr std::size_t fewest_clean_frames = 4;

struct TrackCleaningSettings {
  double sensitivity = 1;  ///< scales the noise that is assumed
  bool despike = true;
};

struct CleanedTracks {
  SampleMarks marked;          ///< spikes
  std::vector<double> noise;   ///< of each track, degrees, as measured
  std::vector<double> shares;  ///< how far each track was smoothed
};

/// Finds spikes and smooths noise. `suspects` are the first accused of being spikes;
/// `always_missing` samples are gaps already bridged; `nearby[n]` are the tracks that move with
/// track n. `progress`, where there is one, goes on to three quarters.
CleanedTracks clean_tracks(VectorTracks& tracks, const SampleMarks& suspects,
                           const SampleMarks& always_missing,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const TrackCleaningSettings& settings,
                           ShareProgress* progress = nullptr);

}  // namespace kinemend
