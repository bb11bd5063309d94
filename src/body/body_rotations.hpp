// The rotations of a track in the frames of a layout, and continuous rotation vectors of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "body/body_frame.hpp"
#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// The rotations q of a track that the take has, as the layout's are (F): of the first track in the
/// body's frame.
std::vector<Quat> track_rotations(const Take& clip, const BodyMatch& match, const RootMotion& root,
                                  const BodyChannels& channels, std::size_t track);

/// Continues rotation vectors of length up to pi from sample to sample, past half a turn. A few
/// samples that are thrown far off (more than 60 degrees) do not turn the motion that goes on after
/// them. A joint that turns on, and stays more than 210 degrees away for half a second, starts anew
/// from the vector of length up to pi: models know no joint that has turned once round.
void continue_vectors(std::span<Vec3> vectors, double frame_rate_hz);

}  // namespace kinemend::representation
