// Recognises takes whose frames are fewer measurements than they seem: samples of a lower rate,
// each held for some frames or joined by straight lines.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

enum class SampleJoin { none, held, linear };

/// Measurements were made at the times `first`, `first + step`, ... in frames; the frames between
/// repeat or interpolate them. The step of held samples may be broken: 24 Hz at 60 are held for two
/// and for three frames in turn.
struct SamplePattern {
  SampleJoin join = SampleJoin::none;
  double step = 1;
  double first = 0;  ///< above -1, and no later than a step after the first frame

  double time(std::size_t sample) const { return first + static_cast<double>(sample) * step; }
  /// The first frame that shows a measurement.
  std::size_t frame(std::size_t sample) const {
    return static_cast<std::size_t>(std::ceil(time(sample) - same_time));
  }
  /// How many measurements so many frames show; those before the first are of none of them.
  std::size_t samples(std::size_t frames) const {
    const double last = static_cast<double>(frames) - 1 - first + same_time;
    return last < 0 ? 0 : 1 + static_cast<std::size_t>(last / step);
  }

  // Rounding of the times of a clock.
  static constexpr double same_time = 1e-6;  ///< frames
};

/// The pattern that nine tenths of the tracks that move share; `join` is `none` without one. A
/// held sample leaves differences of order 1 that all but vanish at every frame of a period of 2 to
/// 8 but one, an interpolated one those of order 2. Else frames that repeat the one before on nine
/// tenths of these tracks show a pattern if they are those of a clock of 1.1 to 8 frames, all of
/// them. `missing` samples do not count.
SamplePattern find_sample_pattern(const VectorTracks& tracks, const SampleMarks& missing,
                                  const HeldTuning& tuning = {});

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
