// Recognises takes with fewer measurements than frames: samples of a lower rate, each held for some
// frames or joined by straight lines.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "methods/auto/tuning.hpp"
#include "methods/auto/vector_tracks.hpp"

namespace kinemend {

enum class SampleJoin { none, held, linear };

/// Measurements were made at the times `first`, `first + step`, ... in frames; the frames between
/// repeat or interpolate them. The step of held samples may be fractional: 24 Hz at 60 are held for
/// two and for three frames in turn.
struct SamplePattern {
  SampleJoin join = SampleJoin::none;
  double step = 1;
  double first = 0;  ///< above -1, and at most a step after the first frame

  double time(std::size_t sample) const { return first + static_cast<double>(sample) * step; }
  /// The first frame that shows a measurement.
  std::size_t frame(std::size_t sample) const {
    return static_cast<std::size_t>(std::ceil(time(sample) - same_time));
  }
  /// The number of measurements that the first `frames` frames show; frames before the first show
  /// none.
  std::size_t samples(std::size_t frames) const {
    const double last = static_cast<double>(frames) - 1 - first + same_time;
    return last < 0 ? 0 : 1 + static_cast<std::size_t>(last / step);
  }

  // Tolerance for rounding of clock times.
  static constexpr double same_time = 1e-6;  ///< frames
};

/// The pattern that nine tenths of the moving tracks share; `join` is `none` without one. A held
/// sample leaves differences of order 1 that almost vanish at all but one frame of a period of 2 to
/// 8, an interpolated one those of order 2. Otherwise, frames that repeat the one before on nine
/// tenths of these tracks form a pattern if all the others fit a clock of 1.1 to 8 frames.
/// `missing` samples are ignored.
SamplePattern find_sample_pattern(const VectorTracks& tracks, const SampleMarks& missing,
                                  const HeldTuning& tuning = {});

/// The samples at the frames of the measurements.
VectorTracks measured_samples(const VectorTracks& tracks, const SamplePattern& pattern);
/// The marks at the frames of the measurements.
SampleMarks marks_of_samples(const SampleMarks& marks, const SamplePattern& pattern);

/// Expands cleaned measurements to all frames: a natural cubic spline through them, blended in by
/// `shares`. Frames that depend on a `marked` measurement are joined again as before, and marked in
/// the result; all other frames of a track of share 0 are unchanged.
SampleMarks spread_samples(const VectorTracks& samples, const SampleMarks& marked,
                           const std::vector<double>& shares, const SamplePattern& pattern,
                           VectorTracks& tracks);

}  // namespace kinemend
