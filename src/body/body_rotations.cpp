// Turns rotations into the layout's frames and continues vectors beyond half a turn.
#include "body/body_rotations.hpp"

#include <algorithm>

#include "body/rotation_channels.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/experimental/representation.hpp"

namespace kinemend::representation {

namespace {

class VectorContinuation {
 public:
  explicit VectorContinuation(Vec3 first) : previous_(first), steady_(first) {}

  // Returns `v` or another vector of the same rotation.
  Vec3 next(Vec3 v) {
    const Vec3 from_steady = continue_rotation_vector(v, steady_);
    const Vec3 from_previous = continue_rotation_vector(v, previous_);
    previous_ =
        norm(from_steady - steady_) < norm(from_previous - previous_) ? from_steady : from_previous;
    if (norm(previous_ - steady_) < steady_rad || ++frames_away_ > patience_frames) {
      steady_ = previous_;
      frames_away_ = 0;
    }
    return previous_;
  }

 private:
  Vec3 previous_, steady_;
  int frames_away_ = 0;
};

}  // namespace

std::vector<Quat> track_rotations(const Take& clip, const BodyMatch& match, const RootMotion& root,
                                  const BodyChannels& channels, std::size_t track) {
  const auto joint = static_cast<std::size_t>(match.tracks[track]);
  const std::size_t frames = clip.frame_count();
  std::vector<Quat> rotations(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    rotations[f] = track == 0 ? exp({0, -channels.headings[f], 0}) * root.rotations[f]
                              : match.before[track] * clip.rotation(f, joint) * match.after[track];
  }
  return rotations;
}

void continue_vectors(std::span<Vec3> vectors, double frame_rate_hz) {
  // The longest time that a vector may be too far away (docs/bodies.md). Chosen by hand, not swept.
  constexpr double patience_s = 0.5;
  if (vectors.empty()) return;
  const auto patience =
      static_cast<std::size_t>(std::max(8.0, patience_s * window_rate_hz(frame_rate_hz)));
  VectorContinuation continuation(vectors.front());
  std::vector<Vec3> beyond;
  for (std::size_t f = 1; f < vectors.size();) {
    // A stretch beyond half a turn; it is empty if this sample is within half a turn.
    VectorContinuation onward = continuation;
    beyond.clear();
    std::size_t far_samples = 0;
    for (std::size_t g = f; g < vectors.size() && far_samples <= patience; ++g) {
      const Vec3 v = onward.next(vectors[g]);
      if (v == vectors[g]) break;
      beyond.push_back(v);
      far_samples += norm(v) > farthest_turn_rad ? 1 : 0;
    }
    if (far_samples > patience) {
      continuation = VectorContinuation(vectors[f++]);
      continue;
    }
    for (const Vec3 v : beyond) {
      continuation.next(vectors[f]);
      vectors[f++] = v;
    }
    if (f < vectors.size()) continuation.next(vectors[f++]);
  }
}

}  // namespace kinemend::representation
