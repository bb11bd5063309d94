#pragma once

#include <span>
#include <vector>

#include "base/progress.hpp"
#include "kinemend/rotation.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

/// Samples of one joint that stand far off the middle of their neighbours: more than 6 times what
/// is usual about them and more than 6 degrees. They are replaced in `track` by that middle, so
/// that a smooth reference can be laid through it. Takes under 5 frames have none. Returns F marks.
std::vector<std::uint8_t> replace_gross_spikes(std::vector<Quat>& track);

/// The joints within three bones of each joint, itself left out.
std::vector<std::vector<std::size_t>> joints_nearby(std::span<const std::int32_t> parents);

struct SpikeVerdicts {
  SampleMarks marked;
  std::vector<double> noise;  ///< of each track without its spikes, degrees
};

/// Which samples are spikes. Each is predicted from the others of its track by a robust smoother;
/// the worst of their neighbourhood are accused and the smoother fitted again without them, until
/// nothing changes. On tracks that are quiet a verdict needs more: a spike there is large, alone,
/// and no joint nearby moves with it. `suspects` are the first accused; `nearby[n]` the tracks that
/// move with track n; `missing` samples are gaps already bridged, of which none is a spike. Marked
/// samples of `tracks` come back interpolated, and so do bridges that start or end at one.
/// `progress`, where there is one, goes on to two fifths.
SpikeVerdicts find_spikes(VectorTracks& tracks, const SampleMarks& suspects,
                          const std::vector<std::vector<std::size_t>>& nearby, double frame_rate_hz,
                          const SampleMarks* missing = nullptr, ShareProgress* progress = nullptr);

}  // namespace kinemend
