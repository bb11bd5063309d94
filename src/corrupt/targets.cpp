#include "corrupt/targets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend::corrupt {

namespace {

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (comma > 0) parts.emplace_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return parts;
}

// None where the list holds nothing but commas.
std::vector<std::uint8_t> named_joints(const Skeleton& skeleton, std::string_view list) {
  const std::vector<std::string> patterns = split(list);
  if (patterns.empty() && !list.empty())
    return std::vector<std::uint8_t>(skeleton.joint_count(), 0);
  return names_meant(skeleton.names, patterns, "joint");
}

std::vector<std::size_t> child_counts(const Skeleton& skeleton) {
  std::vector<std::size_t> counts(skeleton.joint_count(), 0);
  for (const std::int32_t parent : skeleton.parents) {
    if (parent >= 0) ++counts[static_cast<std::size_t>(parent)];
  }
  return counts;
}

// The first joint of the part that each joint is in, short parts not yet joined to others.
std::vector<std::size_t> part_heads(const Skeleton& skeleton) {
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

void join_short_parts(const Skeleton& skeleton, std::vector<std::size_t>& heads) {
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
  const auto named = named_joints(skeleton, options.joints);
  bool any_channels = false;
  for (const auto& channels : skeleton.channels) any_channels = any_channels || !channels.empty();
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const bool turns = !any_channels || skeleton.rotation_order(j).count > 0;
    if (named[j] && turns && (options.root || skeleton.parents[j] >= 0)) joints.push_back(j);
  }
  return joints;
}

std::vector<std::size_t> limbs(const Skeleton& skeleton) {
  auto heads = part_heads(skeleton);
  join_short_parts(skeleton, heads);
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

void set_rotation(Clip& clip, std::size_t frame, std::size_t joint, Quat rotation) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  const bool restricted = order.count == 1 || order.count == 2;
  clip.rotation(frame, joint) =
      restricted ? from_euler(to_euler(rotation, order), order) : normalized(rotation);
}

std::vector<std::array<double, 3>> euler_track(const Clip& clip, std::size_t joint) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  std::vector<std::array<double, 3>> track(clip.frame_count());
  std::array<double, 3> previous{};
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    previous = track[f] = to_euler_near(clip.rotation(f, joint), order, previous);
  }
  return track;
}

}  // namespace kinemend::corrupt
