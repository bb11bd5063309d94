#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/body.hpp"
#include "representation/body_frame.hpp"

namespace kinemend::representation {

/// The rotations q of a part that the take has, as the layout's are (F): of the first part in the
/// body's frame.
std::vector<Quat> part_rotations(const Clip& clip, const BodyMatch& match, const RootMotion& root,
                                 const BodyChannels& channels, std::size_t part);

/// Continues rotation vectors from frame to frame past half a turn. A few frames that are thrown
/// far off (more than 60 degrees) do not turn the motion that goes on after them.
class VectorContinuation {
 public:
  /// `v` or another vector of the same rotation. The first one is taken as it is.
  Vec3 next(Vec3 v);

 private:
  Vec3 previous_, steady_;
  int frames_away_ = -1;  // -1: nothing came yet
};

}  // namespace kinemend::representation
