// Turns the frames of a take's joints into those of a layout, by the bones of both.
#pragma once

#include "body/body_rest.hpp"
#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// Directions of the bones of a take's tracks at rest, upright axes: to the track's only child, or
/// to the one thing that hangs on a joint without any; zero where that is not told or has no
/// length.
std::vector<Vec3> bone_directions(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                                  const std::vector<std::int32_t>& tracks);

/// Sets `match.before` and `match.after`. A track's frame is turned from the take's rest to that of
/// the layout by the shortest rotation that brings their bones together after the track above was
/// turned, so that a bone keeps its twist against its neighbour; a bone that is not known turns
/// with the track above.
void align_joints(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                  BodyMatch& match);

/// The nearest track above that the take has, by the layout's tree; -1 where there is none.
std::int32_t matched_parent(const BodyLayout& layout, const std::vector<std::int32_t>& tracks,
                            std::size_t track);

}  // namespace kinemend::representation
