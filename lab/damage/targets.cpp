// Matches names with patterns, divides a skeleton into limbs, and reads and turns samples.
#include "lab/damage/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"
#include "motion/names.hpp"
#include "motion/take.hpp"

namespace kinemend::corrupt {

namespace {

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> names;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (comma > 0) names.emplace_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return names;
}

// Returns 1 for the names that the list matches. A list of only commas matches none.
std::vector<std::uint8_t> named_tracks(const std::vector<std::string>& names, std::string_view list,
                                       std::string_view noun) {
  const std::vector<std::string> patterns = split(list);
  if (patterns.empty() && !list.empty()) return std::vector<std::uint8_t>(names.size(), 0);
  return names_meant(names, patterns, noun);
}

// Returns the first joint of each joint's limb, before short limbs are joined to others.
std::vector<std::size_t> limb_heads(const Skeleton& skeleton) {
  // The branchings at hips and chest, as the header says. By definition.
  constexpr int dividing_branchings = 2;
  const auto children = child_counts(skeleton);
  std::vector<std::size_t> heads(skeleton.joint_count());
  std::vector<int> branchings(skeleton.joint_count(), 0);
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    heads[j] = j;
    if (skeleton.parents[j] < 0) continue;
    const auto parent = static_cast<std::size_t>(skeleton.parents[j]);
    const bool branches = children[parent] > 1;
    branchings[j] = branchings[parent] + (branches ? 1 : 0);
    const bool starts =
        (branches && branchings[j] <= dividing_branchings) || skeleton.parents[parent] < 0;
    if (!starts) heads[j] = heads[parent];
  }
  return heads;
}

void join_short_limbs(const Skeleton& skeleton, std::vector<std::size_t>& heads) {
  // The least number of joints, as the header says. By definition.
  constexpr std::size_t shortest = 3;
  for (std::size_t head = skeleton.joint_count(); head-- > 0;) {
    if (heads[head] != head || skeleton.parents[head] < 0) continue;
    const auto parent = static_cast<std::size_t>(skeleton.parents[head]);
    const auto size = static_cast<std::size_t>(std::count(heads.begin(), heads.end(), head));
    if (size >= shortest || skeleton.parents[parent] < 0) continue;
    std::replace(heads.begin(), heads.end(), head, heads[parent]);
  }
}

}  // namespace

std::vector<std::size_t> target_joints(const Skeleton& skeleton, const TargetOptions& options) {
  const auto named = named_tracks(skeleton.names, options.joints, "joint");
  bool any_channels = false;
  for (const auto& channels : skeleton.channels) any_channels = any_channels || !channels.empty();
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const bool turns = !any_channels || skeleton.rotation_order(j).count > 0;
    if (named[j] && turns && (options.root || skeleton.parents[j] >= 0)) joints.push_back(j);
  }
  return joints;
}

std::vector<std::size_t> target_tracks(const Take& clip, const TargetOptions& options) {
  return target_joints(clip.skeleton, options);
}

std::vector<std::size_t> target_tracks(const VectorMotion& motion, const TargetOptions& options) {
  const auto named = named_tracks(motion.names, options.joints, "marker");
  std::vector<std::size_t> tracks;
  for (std::size_t n = 0; n < motion.track_count(); ++n) {
    if (named[n] != 0 && (options.root || motion.is_root[n] == 0)) tracks.push_back(n);
  }
  return tracks;
}

std::vector<std::size_t> limbs(const Skeleton& skeleton) {
  auto heads = limb_heads(skeleton);
  join_short_limbs(skeleton, heads);
  std::vector<std::size_t> numbers(heads.size());
  std::size_t next = 0;
  for (std::size_t j = 0; j < heads.size(); ++j)
    numbers[j] = heads[j] == j ? next++ : numbers[heads[j]];
  return numbers;
}

std::vector<Unit> units(const Skeleton& skeleton, const TargetOptions& options,
                        std::string_view scope) {
  const auto joints = target_joints(skeleton, options);
  std::vector<Unit> result;
  if (scope == "all") {
    if (!joints.empty()) result.push_back({joints, -1});
  } else if (scope == "limb") {
    const auto numbers = limbs(skeleton);
    for (std::size_t limb = 0; limb <= *std::max_element(numbers.begin(), numbers.end()); ++limb) {
      Unit unit;
      for (const std::size_t j : joints) {
        if (numbers[j] == limb) unit.joints.push_back(j);
      }
      if (!unit.joints.empty()) result.push_back(std::move(unit));
    }
  } else {
    for (const std::size_t j : joints) {
      const int channels = scope == "channel" ? skeleton.rotation_order(j).count : 0;
      if (channels == 0) result.push_back({{j}, -1});
      for (int c = 0; c < channels; ++c) result.push_back({{j}, c});
    }
  }
  return result;
}

std::vector<Unit> units(const Take& clip, const TargetOptions& options, std::string_view scope) {
  return units(clip.skeleton, options, scope);
}

std::vector<Unit> units(const VectorMotion& motion, const TargetOptions& options,
                        std::string_view scope) {
  const auto tracks = target_tracks(motion, options);
  if (scope == "all" && !tracks.empty()) return {{tracks, -1}};
  std::vector<Unit> result;
  for (const std::size_t n : tracks) {
    if (scope != "channel") result.push_back({{n}, -1});
    for (int c = 0; scope == "channel" && c < 3; ++c) result.push_back({{n}, c});
  }
  return result;
}

Vec3 vector_at(const VectorMotion& motion, std::size_t frame, std::size_t track) {
  const double* v = motion.values.row(frame).data() + 3 * track;
  return {v[0], v[1], v[2]};
}

void set_vector(VectorMotion& motion, std::size_t frame, std::size_t track, Vec3 value) {
  double* v = motion.values.row(frame).data() + 3 * track;
  v[0] = value.x;
  v[1] = value.y;
  v[2] = value.z;
}

bool is_observed(const VectorMotion& motion, std::size_t frame, std::size_t track) {
  return motion.observed[frame * motion.track_count() + track] != 0;
}

Vec3 mean_position(const VectorMotion& motion, std::size_t frame) {
  Vec3 sum;
  double count = 0;
  for (std::size_t n = 0; n < motion.track_count(); ++n) {
    if (motion.is_rotation[n] != 0 || !is_observed(motion, frame, n)) continue;
    sum += vector_at(motion, frame, n);
    ++count;
  }
  return count > 0 ? (1 / count) * sum : sum;
}

void turn(Take& clip, std::size_t frame, std::size_t joint, Vec3 n) {
  set_rotation(clip, frame, joint, clip.rotation(frame, joint) * exp(n));
}

namespace {

// Returns the rotation vector nearest to `other` that has the rotation of `v`; these differ by full
// turns.
Vec3 nearest_vector(Vec3 v, Vec3 other) {
  const double angle = norm(v);
  if (angle < 1e-12) return v;
  const double turns = std::round((dot(v, other) / angle - angle) / (2 * pi));
  return (1 + 2 * pi * turns / angle) * v;
}

}  // namespace

void turn(VectorMotion& motion, std::size_t frame, std::size_t track, Vec3 n) {
  if (!is_observed(motion, frame, track)) return;
  const Vec3 old = vector_at(motion, frame, track);
  if (motion.is_rotation[track] == 0) {
    set_vector(motion, frame, track, old + motion.per_radian * n);
    return;
  }
  const Vec3 v = (1 / motion.per_radian) * old;
  set_vector(motion, frame, track, motion.per_radian * nearest_vector(log(exp(v) * exp(n)), v));
}

void set_rotation(Take& clip, std::size_t frame, std::size_t joint, Quat rotation) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  const bool restricted = order.count == 1 || order.count == 2;
  clip.rotation(frame, joint) =
      restricted ? from_euler(to_euler(rotation, order), order) : normalized(rotation);
}

std::vector<std::array<double, 3>> euler_track(const Take& clip, std::size_t joint) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  std::vector<std::array<double, 3>> track(clip.frame_count());
  std::array<double, 3> previous{};
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    previous = track[f] = to_euler_near(clip.rotation(f, joint), order, previous);
  }
  return track;
}

}  // namespace kinemend::corrupt
