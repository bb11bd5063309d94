// Converts the frames of a take's joints to those of a layout, by the bones of both.
#pragma once

#include "body/body_rest.hpp"
#include "kinemend/experimental/body.hpp"

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

/// Returns the nearest ancestor in the layout's tree that the take has; -1 if there is none.
std::int32_t matched_parent(const BodyLayout& layout, const std::vector<std::int32_t>& tracks,
                            std::size_t track);

}  // namespace kinemend::representation
