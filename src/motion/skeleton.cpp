// Checks the rules of a skeleton, computes the global positions of its joints (forward kinematics),
// and estimates the height of a body and the unit that its lengths are in.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/take.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

void check_channels(const Skeleton& skeleton, std::size_t joint) {
  const auto& channels = skeleton.channels[joint];
  std::vector<Axis> turns;
  std::array<bool, 3> seen_position{};
  for (const Channel channel : channels) {
    const auto axis = static_cast<std::size_t>(axis_of(channel));
    if (is_rotation(channel)) {
      if (!turns.empty() && turns.back() == axis_of(channel)) {
        throw Error(ErrorKind::usage,
                    fmt::format("joint {} \"{}\": a rotation channel follows itself", joint,
                                skeleton.names[joint]));
      }
      turns.push_back(axis_of(channel));
    } else if (std::exchange(seen_position[axis], true)) {
      throw Error(ErrorKind::usage, fmt::format("joint {} \"{}\": a position channel occurs twice",
                                                joint, skeleton.names[joint]));
    }
  }
  if (turns.size() > 3) {
    throw Error(ErrorKind::usage,
                fmt::format("joint {} \"{}\": {} rotation channels, at most 3 are possible", joint,
                            skeleton.names[joint], turns.size()));
  }
}

}  // namespace

std::int32_t Skeleton::find(std::string_view name) const noexcept {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<std::int32_t>(found - names.begin());
}

RotationOrder Skeleton::rotation_order(std::size_t joint) const {
  RotationOrder order;
  for (const Channel channel : channels[joint]) {
    if (is_rotation(channel) && order.count < 3) order.axes[order.count++] = axis_of(channel);
  }
  return order;
}

bool Skeleton::has_position_channels(std::size_t joint) const {
  return std::any_of(channels[joint].begin(), channels[joint].end(),
                     [](Channel c) { return !is_rotation(c); });
}

std::int32_t Skeleton::add_joint(std::string name, std::int32_t parent, Vec3 offset,
                                 std::vector<Channel> joint_channels) {
  names.push_back(std::move(name));
  parents.push_back(parent);
  offsets.push_back(offset);
  rest_rotations.emplace_back();
  channels.push_back(std::move(joint_channels));
  return static_cast<std::int32_t>(names.size()) - 1;
}

void Skeleton::validate() const {
  const std::size_t count = names.size();
  if (count == 0) throw Error(ErrorKind::usage, "a skeleton has at least one joint");
  if (parents.size() != count || offsets.size() != count || rest_rotations.size() != count ||
      channels.size() != count) {
    throw Error(ErrorKind::usage, "skeleton arrays differ in length");
  }
  if (parents[0] != -1) throw Error(ErrorKind::usage, "joint 0 is not a root");
  for (std::size_t j = 0; j < count; ++j) {
    if (parents[j] < -1 || parents[j] >= static_cast<std::int32_t>(j)) {
      throw Error(ErrorKind::usage, fmt::format("joint {} \"{}\": parent {} does not precede it", j,
                                                names[j], parents[j]));
    }
    if (!is_finite(offsets[j])) {
      throw Error(ErrorKind::usage,
                  fmt::format("joint {} \"{}\": offset is not finite", j, names[j]));
    }
    if (!(std::fabs(norm(rest_rotations[j]) - 1) <= 1e-9)) {
      throw Error(
          ErrorKind::usage,
          fmt::format("joint {} \"{}\": rest rotation is not a unit quaternion", j, names[j]));
    }
    check_channels(*this, j);
  }
  for (const EndSite& site : end_sites) {
    if (site.parent < 0 || site.parent >= static_cast<std::int32_t>(count) ||
        !is_finite(site.offset)) {
      throw Error(ErrorKind::usage,
                  "an end site has no parent joint or an offset that is not finite");
    }
  }
}

std::vector<std::size_t> child_counts(const Skeleton& skeleton) {
  std::vector<std::size_t> counts(skeleton.joint_count(), 0);
  for (const std::int32_t parent : skeleton.parents) {
    if (parent >= 0) ++counts[static_cast<std::size_t>(parent)];
  }
  return counts;
}

std::vector<Channel> make_channels(bool with_position, RotationOrder order) {
  std::vector<Channel> channels;
  if (with_position) channels = {Channel::x_position, Channel::y_position, Channel::z_position};
  for (std::size_t i = 0; i < order.count; ++i) {
    channels.push_back(static_cast<Channel>(static_cast<int>(Channel::x_rotation) +
                                            static_cast<int>(order.axes[i])));
  }
  return channels;
}

namespace {

// Returns a joint's offset from its parent in one frame.
Vec3 offset_of(const Take& clip, std::size_t frame, std::size_t joint,
               std::size_t& next_translated) {
  if (joint == 0) return clip.root_position(frame);
  const std::size_t width = clip.translated_joints.size();
  if (next_translated < width &&
      clip.translated_joints[next_translated] == static_cast<std::int32_t>(joint)) {
    return clip.position(frame, ++next_translated);
  }
  return clip.skeleton.offsets[joint];
}

void forward_kinematics_into(const Take& clip, std::size_t frame, Pose& pose) {
  const Skeleton& skeleton = clip.skeleton;
  std::size_t next_translated = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const Vec3 offset = offset_of(clip, frame, j, next_translated);
    const Quat local = skeleton.rest_rotations[j] * clip.rotation(frame, j);
    if (skeleton.parents[j] < 0) {
      pose.rotations[j] = local;
      pose.positions[j] = offset;
    } else {
      const auto parent = static_cast<std::size_t>(skeleton.parents[j]);
      pose.rotations[j] = pose.rotations[parent] * local;
      pose.positions[j] = pose.positions[parent] + rotate(pose.rotations[parent], offset);
    }
  }
}

Pose empty_pose(const Take& clip) {
  return {std::vector<Quat>(clip.joint_count()), std::vector<Vec3>(clip.joint_count())};
}

}  // namespace

Pose forward_kinematics(const Take& clip, std::size_t frame) {
  Pose pose = empty_pose(clip);
  forward_kinematics_into(clip, frame, pose);
  return pose;
}

std::vector<Vec3> joint_positions(const Take& clip, bool with_end_sites) {
  const auto& end_sites = clip.skeleton.end_sites;
  const std::size_t width = clip.joint_count() + (with_end_sites ? end_sites.size() : 0);
  std::vector<Vec3> positions;
  positions.reserve(clip.frame_count() * width);
  Pose pose = empty_pose(clip);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    forward_kinematics_into(clip, f, pose);
    positions.insert(positions.end(), pose.positions.begin(), pose.positions.end());
    if (!with_end_sites) continue;
    for (const EndSite& site : end_sites) {
      const auto parent = static_cast<std::size_t>(site.parent);
      positions.push_back(pose.positions[parent] + rotate(pose.rotations[parent], site.offset));
    }
  }
  return positions;
}

double body_height(const Skeleton& skeleton) {
  Take rest;
  rest.skeleton = skeleton;
  rest.positions.resize(1);
  rest.rotations.resize(skeleton.joint_count());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Vec3 p : joint_positions(rest, true)) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0.0});
}

std::optional<LengthUnit> guess_length_unit(const Skeleton& skeleton) {
  // The CMU database's unit is 1 / 0.45 inch. The ranges of heights do not overlap.
  static constexpr std::array<LengthUnit, 5> units{
      {{"m", 1.0}, {"CMU unit", 0.0254 / 0.45}, {"inch", 0.0254}, {"cm", 0.01}, {"mm", 0.001}}};
  const double height = body_height(skeleton);
  for (const LengthUnit& unit : units) {
    const double metres = height * unit.metres;
    if (metres >= 1.2 && metres <= 2.5) return unit;
  }
  return std::nullopt;
}

double body_height(const Take& clip) {
  // Frames spread evenly over the take, for speed; ratio of the body height to the quartile of the
  // distances; heights of people. Chosen by hand, not swept.
  constexpr std::size_t most_frames = 64;
  constexpr double heights_per_quartile = 4.2;
  constexpr double usual_m = 1.75, tallest_m = 2.2;
  std::vector<double> distances;
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  std::vector<Vec3> seen;
  for (std::size_t i = 0; i < sampled; ++i) {
    const std::size_t f = sampled < 2 ? 0 : i * (frames - 1) / (sampled - 1);
    seen.clear();
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      if (clip.holds_positions(m) && clip.is_observed(f, m)) seen.push_back(clip.position(f, m));
    }
    for (std::size_t a = 0; a < seen.size(); ++a) {
      for (std::size_t b = a + 1; b < seen.size(); ++b)
        distances.push_back(norm(seen[a] - seen[b]));
    }
  }
  const double unit_m = metres_per_unit(clip.unit);
  const double quartile = distances.empty() ? 0 : of_rank(distances, distances.size() / 4);
  if (!(quartile > 0)) return unit_m > 0 ? usual_m / unit_m : 1.0;
  const double height = heights_per_quartile * quartile;
  return unit_m > 0 ? std::min(height, tallest_m / unit_m) : height;
}

double likely_metres_per_unit(const Take& take) {
  if (!take.has_joints()) return metres_per_unit(take.unit);
  if (take.metres_per_unit > 0) return take.metres_per_unit;
  const auto guess = guess_length_unit(take.skeleton);
  return guess ? guess->metres : 0;
}

}  // namespace kinemend
