// Finds the direction of each bone at rest and the shortest rotation that turns it to the layout's,
// turns rotations into the layout's frames, and continues vectors beyond half a turn.
#include "body/body_rotations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "body/representation.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend::representation {

namespace {

// Returns the single child joint or end site of a joint; none if it has several.
std::optional<Vec3> only_end(const Skeleton& skeleton, const RestPose& rest, std::int32_t joint) {
  std::optional<Vec3> end;
  int count = 0;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.parents[j] != joint) continue;
    end = rest.positions[j];
    ++count;
  }
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e) {
    if (skeleton.end_sites[e].parent != joint) continue;
    end = rest.positions[skeleton.joint_count() + e];
    ++count;
  }
  return count == 1 ? end : std::nullopt;
}

// Returns the global rotation of a joint if all local rotations are identity.
Quat unturned_rotation(const Skeleton& skeleton, std::int32_t joint) {
  Quat rotation;
  for (; joint >= 0; joint = skeleton.parents[static_cast<std::size_t>(joint)])
    rotation = skeleton.rest_rotations[static_cast<std::size_t>(joint)] * rotation;
  return rotation;
}

// Returns the only child of each track; -1 if it has none, -2 if several.
std::vector<std::int32_t> only_children(const BodyLayout& layout) {
  std::vector<std::int32_t> children(layout.track_count(), -1);
  for (std::size_t i = 1; i < layout.track_count(); ++i) {
    std::int32_t& child = children[static_cast<std::size_t>(layout.parents[i])];
    child = child == -1 ? static_cast<std::int32_t>(i) : -2;
  }
  return children;
}

}  // namespace

std::vector<Vec3> bone_directions(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                                  const std::vector<std::int32_t>& tracks) {
  // Shorter bones have no direction. Chosen by hand, not swept.
  constexpr double least_share = 1e-3;  // of all the skeleton's bones
  double all = 0;
  for (const Vec3 offset : clip.skeleton.offsets) all += norm(offset);
  const std::vector<std::int32_t> children = only_children(layout);
  std::vector<Vec3> directions(layout.track_count());
  for (std::size_t i = 1; i < layout.track_count(); ++i) {
    if (tracks[i] < 0 || children[i] == -2) continue;
    std::optional<Vec3> end;
    if (children[i] == -1) {
      end = only_end(clip.skeleton, rest, tracks[i]);
    } else if (const std::int32_t child = tracks[static_cast<std::size_t>(children[i])];
               child >= 0) {
      end = rest.positions[static_cast<std::size_t>(child)];
    }
    if (!end) continue;
    const Vec3 bone = *end - rest.positions[static_cast<std::size_t>(tracks[i])];
    const double length = norm(bone);
    if (length > least_share * all) directions[i] = rotate(rest.upright, (1 / length) * bone);
  }
  return directions;
}

std::int32_t matched_parent(const BodyLayout& layout, const std::vector<std::int32_t>& tracks,
                            std::size_t track) {
  std::int32_t above = layout.parents[track];
  while (above >= 0 && tracks[static_cast<std::size_t>(above)] < 0)
    above = layout.parents[static_cast<std::size_t>(above)];
  return above;
}

void align_joints(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                  BodyMatch& match) {
  const std::size_t count = layout.track_count();
  const std::vector<Vec3> bones = bone_directions(layout, clip, rest, match.tracks);
  std::vector<Quat> turns(count);
  match.before.assign(count, {});
  match.after.assign(count, {});
  for (std::size_t i = 0; i < count; ++i) {
    if (match.tracks[i] < 0) continue;
    const auto joint = static_cast<std::size_t>(match.tracks[i]);
    const Quat frame = rest.upright * rest.rotations[joint];
    const std::int32_t above = matched_parent(layout, match.tracks, i);
    if (above < 0) {
      match.before[i] = match.upright * unturned_rotation(clip.skeleton, match.tracks[i]);
      match.after[i] = conjugate(frame);
      continue;
    }
    const Quat parent = turns[static_cast<std::size_t>(above)];
    turns[i] = parent;
    if (norm(bones[i]) > 0 && norm(layout.bones[i]) > 0)
      turns[i] = shortest_rotation(rotate(parent, layout.bones[i]), bones[i]) * parent;
    match.before[i] = conjugate(parent) * rest.upright * rest.unturned[joint];
    match.after[i] = conjugate(frame) * turns[i];
  }
}

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
