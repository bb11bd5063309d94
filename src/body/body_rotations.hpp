// The rotations of a track in the frames of a layout, and continuous rotation vectors of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "body/body_frame.hpp"
#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

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
