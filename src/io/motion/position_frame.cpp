// Makes the position frames of formats whose positions replace a joint's offset, or are added to
// it.
#include "io/motion/position_frame.hpp"

namespace kinemend {

namespace {

template <class MakeFrame>
std::vector<PositionFrame> frames_of(const Skeleton& skeleton, MakeFrame&& make_frame) {
  std::vector<PositionFrame> frames;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    if (j == 0 || skeleton.has_position_channels(j)) frames.push_back(make_frame(j));
  }
  return frames;
}

}  // namespace

std::vector<PositionFrame> offset_replacing_frames(const Skeleton& skeleton) {
  return frames_of(skeleton, [&](std::size_t j) {
    return PositionFrame{skeleton.offsets[j], {}, {}};
  });
}

std::vector<PositionFrame> offset_adding_frames(const Skeleton& skeleton) {
  return frames_of(skeleton, [&](std::size_t j) {
    return PositionFrame{{}, skeleton.offsets[j], j == 0 ? Quat{} : skeleton.rest_rotations[j]};
  });
}

}  // namespace kinemend
