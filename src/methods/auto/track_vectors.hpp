// Converts tracks of a take to vectors in degrees, and back: rotations about a smoothed copy of the
// track, positions by a scale. Replaces gross spikes, and finds the tracks that move together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/take_view.hpp"
#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

/// Degrees that `auto` takes a file unit for. Positions of joints: the turn that moves the end of a
/// typical bone by a unit. Markers: 1150 degrees per body height (1 degree is 1.5 mm), since
/// optical systems measure positions more finely than angles are measured.
inline double degrees_per_unit(const TakeView& take) {
  // Chosen by hand (docs/details/auto.md), not swept.
  constexpr double degrees_per_height = 1150;
  return take.markers ? degrees_per_height / take.body_height
                      : degrees_per_radian / radian_of_positions(take);
}
/// The same for a track of this space: rotations are in degrees.
inline double degrees_per_unit(const TakeView& take, Space space) {
  return space == Space::rotation ? 1 : degrees_per_unit(take);
}

struct TrackVectors {
  std::vector<Vec3> vectors;           ///< F; gaps are bridged
  std::vector<std::uint8_t> suspects;  ///< F, initial spike candidates; empty: none
  std::optional<RotationChart> chart;  ///< of rotations
};

/// Rotations in their smooth chart, positions by `degrees_per_unit`.
TrackVectors vectors_of(const TakeView& take, std::size_t number);

/// Some tracks of a take, as input of `find_spikes` and `clean_tracks`.
struct TracksRead {
  VectorTracks vectors;
  SampleMarks suspects;  ///< as of `TrackVectors`
  SampleMarks gaps;      ///< samples that were not observed; their vectors are bridges
  /// One per track, as of `TrackVectors`; empty if they are not kept.
  std::vector<std::optional<RotationChart>> charts;
};
/// The vectors of the tracks `numbers`. Charts take more memory than the vectors, and are kept if
/// `keep_charts`. `progress`, if any, takes a step for each track.
TracksRead read_tracks(const TakeView& take, const std::vector<std::size_t>& numbers,
                       bool keep_charts, ShareProgress* progress = nullptr);

/// A cleaned track from its vectors: those of all samples if it is smoothed, else those of spikes
/// (F marks). `chart` is that of `vectors_of`, which takes more memory than the vectors; null: it
/// is computed again.
CleanedTrack track_of(const TakeView& take, std::size_t number, std::span<const Vec3> vectors,
                      std::span<const std::uint8_t> spikes, bool smoothed,
                      const RotationChart* chart = nullptr);

/// The chart of a track without gross spikes. Its reference is the track's Gaussian mean, cut at
/// 2.5 deviations and symmetrically at the ends of the take; path[0] = 0. The signs of the
/// quaternions do not matter.
RotationChart smooth_chart(std::span<const Quat> track, double frame_rate_hz,
                           const ChartTuning& tuning = {});

/// Gross spikes of one joint: samples whose deviation from the mean of their two neighbours exceeds
/// 6 degrees and 6 times the median deviation of the samples about them. In `track` that mean
/// replaces them, so that a smooth reference can be computed. Takes under 5 frames have none.
/// Returns F marks.
std::vector<std::uint8_t> replace_gross_spikes(std::vector<Quat>& track,
                                               const GrossSpikeTuning& tuning = {});

/// The joints within three bones of each joint, without the joint itself.
std::vector<std::vector<std::size_t>> joints_nearby(std::span<const std::int32_t> parents);

/// For each of `tracks`, the indices in that list of the others that move with it. Rotations: the
/// joints near it on the body. Markers: up to four others that keep their distance to it, nearest
/// first: within 0.3 body heights, and usually constant to a 50th of one, in at most 50 frames.
/// Positions of joints: none.
std::vector<std::vector<std::size_t>> tracks_nearby(const TakeView& take,
                                                    const std::vector<std::size_t>& tracks);

}  // namespace kinemend
