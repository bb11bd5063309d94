// The rules of a skeleton, and its joints by name.
#include "kinemend/skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinemend/error.hpp"
#include "motion/take_checks.hpp"

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

std::vector<Channel> make_channels(bool with_position, RotationOrder order) {
  std::vector<Channel> channels;
  if (with_position) channels = {Channel::x_position, Channel::y_position, Channel::z_position};
  for (std::size_t i = 0; i < order.count; ++i) {
    channels.push_back(static_cast<Channel>(static_cast<int>(Channel::x_rotation) +
                                            static_cast<int>(order.axes[i])));
  }
  return channels;
}

}  // namespace kinemend
