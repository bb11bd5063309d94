// Converts rotations of a take's joints to the frames of a layout, by the bones of both, and
// continues rotation vectors of a track.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "body/body_frame.hpp"
#include "body/body_rest.hpp"
#include "kinemend/extend/body.hpp"

namespace kinemend::representation {

/// Returns the directions of the bones of a take's tracks at rest, in upright axes: to the track's
/// only child, or to the single child joint or end site of a track without children. Zero if the
/// direction is ambiguous or the bone has no length.
std::vector<Vec3> bone_directions(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                                  const std::vector<std::int32_t>& tracks);

/// Sets `match.before` and `match.after`. Tracks are handled from the root outward. A track's frame
/// is turned from the take's rest to that of the layout by the shortest rotation that aligns their
/// bones once the parent track is turned, so that a bone keeps its twist against its neighbour. A
/// bone of unknown direction turns with its parent track.
void align_joints(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                  BodyMatch& match);

/// Returns the nearest ancestor in the layout's tree that the take has; -1 if the take has no
/// ancestor of the track.
std::int32_t matched_parent(const BodyLayout& layout, const std::vector<std::int32_t>& tracks,
                            std::size_t track);

/// Returns the rotations q of a track that the take has, in the layout's frames (F); those of the
/// first track are in the body's frame.
std::vector<Quat> track_rotations(const Take& clip, const BodyMatch& match, const RootMotion& root,
                                  const BodyChannels& channels, std::size_t track);

/// Continues rotation vectors of length up to pi from sample to sample, beyond half a turn. A few
/// outlier samples (more than 60 degrees) do not affect the motion after them. A joint that turns
/// farther than 210 degrees for half a second restarts at the vector of length up to pi, because
/// models know no joint that has made a full turn.
void continue_vectors(std::span<Vec3> vectors, double frame_rate_hz);

}  // namespace kinemend::representation
