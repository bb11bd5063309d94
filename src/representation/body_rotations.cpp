#include "representation/body_rotations.hpp"

#include "kinemend/representation.hpp"

namespace kinemend::representation {

std::vector<Quat> part_rotations(const Clip& clip, const BodyMatch& match, const RootMotion& root,
                                 const BodyChannels& channels, std::size_t part) {
  const auto joint = static_cast<std::size_t>(match.parts[part]);
  const std::size_t frames = clip.frame_count();
  std::vector<Quat> rotations(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    rotations[f] = part == 0 ? exp({0, -channels.headings[f], 0}) * root.rotations[f]
                             : match.before[part] * clip.rotation(f, joint) * match.after[part];
  }
  return rotations;
}

Vec3 VectorContinuation::next(Vec3 v) {
  constexpr double near = pi / 3;
  constexpr int patience_frames = 12;
  if (frames_away_ < 0) {
    frames_away_ = 0;
    return previous_ = steady_ = v;
  }
  const Vec3 from_steady = continue_rotation_vector(v, steady_);
  const Vec3 from_previous = continue_rotation_vector(v, previous_);
  previous_ =
      norm(from_steady - steady_) < norm(from_previous - previous_) ? from_steady : from_previous;
  if (norm(previous_ - steady_) < near || ++frames_away_ > patience_frames) {
    steady_ = previous_;
    frames_away_ = 0;
  }
  return previous_;
}

}  // namespace kinemend::representation
