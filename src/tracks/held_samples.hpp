#pragma once

#include <cstddef>
#include <vector>

#include "tracks/vector_tracks.hpp"

/// Takes whose frames are fewer measurements than they seem: samples of a lower rate, each held for
/// some frames or joined by straight lines.
namespace kinemend {

enum class SampleJoin { none, held, linear };

/// Frames `first`, `first + step`, ... are measurements, those between repeat or interpolate them.
struct SamplePattern {
  SampleJoin join = SampleJoin::none;
  std::size_t step = 1;
  std::size_t first = 0;  ///< less than `step`

  std::size_t samples(std::size_t frames) const {
    return frames > first ? 1 + (frames - 1 - first) / step : 0;
  }
  std::size_t frame(std::size_t sample) const { return first + sample * step; }
};

/// The pattern that nine tenths of the tracks that move share; `join` is `none` without one. A
/// held sample leaves differences of order 1 that all but vanish at every frame of a period of 2 to
/// 8 but one, an interpolated one those of order 2. `missing` samples do not count.
SamplePattern find_sample_pattern(const VectorTracks& tracks, const SampleMarks& missing);

/// The measurements alone.
VectorTracks measured_samples(const VectorTracks& tracks, const SamplePattern& pattern);
/// Of each measurement what its frame is marked with.
SampleMarks marks_of_samples(const SampleMarks& marks, const SamplePattern& pattern);

/// Brings cleaned measurements back to all frames: a natural cubic spline through them, blended in
/// by `shares`. Where a measurement is `marked`, the frames that followed from it are joined again
/// as they were, and marked in the result; all other frames of a track of share 0 stay as they are.
SampleMarks spread_samples(const VectorTracks& samples, const SampleMarks& marked,
                           const std::vector<double>& shares, const SamplePattern& pattern,
                           VectorTracks& tracks);

}  // namespace kinemend
