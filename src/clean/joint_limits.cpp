#include "clean/joint_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/representation.hpp"

namespace kinemend {

namespace {

using Angles = std::array<double, 3>;  // radians

constexpr double share_beyond = 0.01;   // of frames in which a limit may be broken and still hold
constexpr double far_deg = 20;          // limits that are broken by more are none
constexpr double negligible_deg = 0.1;  // by which limits are not moved
constexpr double rounding_deg = 1e-9;

Vec3 vector_at(const PoseMatrix& poses, std::size_t frame, std::size_t part) {
  return {poses(frame, 3 * part), poses(frame, 3 * part + 1), poses(frame, 3 * part + 2)};
}

double excess(double angle_deg, const ChannelLimit& limit) {
  return std::max({0.0, limit.minimum - angle_deg, angle_deg - limit.maximum});
}

double excess(const Angles& angles, const EulerLimits& limits) {
  double sum = 0;
  for (std::size_t i = 0; i < limits.order.count; ++i)
    sum += excess(angles[i] * degrees_per_radian, limits.angles[i]);
  return sum;
}

double middle(const ChannelLimit& limit) {
  const bool bounded = std::isfinite(limit.minimum) && std::isfinite(limit.maximum);
  return bounded ? 0.5 * (limit.minimum + limit.maximum) * radians_per_degree : 0.0;
}

// Of the two sets of three angles that make one rotation, the other.
Angles other_branch(const Angles& angles, RotationOrder order) {
  const bool repeats = order.axes[0] == order.axes[2];
  return {angles[0] + pi, repeats ? -angles[1] : pi - angles[1], angles[2] + pi};
}

// The angles nearest to the middle of the limits, whole turns taken off.
Angles near_middle(Angles angles, const EulerLimits& limits) {
  for (std::size_t i = 0; i < limits.order.count; ++i) {
    const double centre = middle(limits.angles[i]);
    angles[i] = centre + wrap_angle(angles[i] - centre, pi);
  }
  return angles;
}

Angles angles_of(Quat local, const EulerLimits& limits) {
  Angles centre{};
  for (std::size_t i = 0; i < limits.order.count; ++i) centre[i] = middle(limits.angles[i]);
  const Angles first = near_middle(to_euler_near(local, limits.order, centre), limits);
  if (limits.order.count < 3) return first;
  const Angles second = near_middle(other_branch(first, limits.order), limits);
  return excess(second, limits) < excess(first, limits) ? second : first;
}

Quat local_of(Vec3 channels, const EulerLimits& limits) {
  return limits.before * exp(radians_per_degree * channels) * limits.after;
}

// The joint's channels within the limits; false where they are so already.
bool clamped(Vec3& channels, const EulerLimits& limits) {
  const Quat local = local_of(channels, limits);
  Angles angles = angles_of(local, limits);
  const double beyond = excess(angles, limits);
  for (std::size_t i = 0; i < limits.order.count; ++i) {
    angles[i] = radians_per_degree * std::clamp(angles[i] * degrees_per_radian,
                                                limits.angles[i].minimum, limits.angles[i].maximum);
  }
  const Quat nearest = from_euler(angles, limits.order);
  // A joint of fewer than three axes also turns where it cannot.
  if (beyond <= rounding_deg &&
      angle_between(local, nearest) * degrees_per_radian <= 1e3 * rounding_deg)
    return false;
  const Vec3 v = log(normalized(conjugate(limits.before) * nearest * conjugate(limits.after)));
  channels = degrees_per_radian * continue_rotation_vector(v, radians_per_degree * channels);
  return true;
}

// Moves one side out to the quantile of the take's angles; by how much.
double widen(ChannelLimit& limit, std::vector<double>& angles_deg) {
  const double low = quantile_of(angles_deg, share_beyond);
  const double high = quantile_of(angles_deg, 1 - share_beyond);
  const double moved = std::max({0.0, limit.minimum - low, high - limit.maximum});
  if (moved <= negligible_deg) return 0;
  limit.minimum = std::min(limit.minimum, low);
  limit.maximum = std::max(limit.maximum, high);
  return moved;
}

}  // namespace

JointLimits learned_joint_limits(const Model& model) {
  JointLimits limits;
  if (!model.tensors.contains("limits")) return limits;
  const std::size_t channels = model.layout.channel_count();
  const Tensor& ranges = model.tensor("limits", {channels, 2});
  for (std::size_t d = 0; d < channels; ++d) {
    limits.channels.push_back({ranges.values[2 * d], ranges.values[2 * d + 1]});
    if (limits.channels.back().minimum > limits.channels.back().maximum) {
      throw Error(
          ErrorKind::unreadable_input,
          fmt::format("the model's limits of {} are upside down", model.layout.channel_name(d)));
    }
  }
  return limits;
}

JointLimits skeleton_joint_limits(const Skeleton& skeleton, const BodyLayout& layout,
                                  const BodyMatch& match) {
  JointLimits limits;
  if (skeleton.limits.empty() || layout.kind != BodyKind::joints) return limits;
  for (std::size_t part = 1; part < layout.part_count(); ++part) {
    if (match.parts[part] < 0) continue;
    const auto joint = static_cast<std::size_t>(match.parts[part]);
    const auto& stated = skeleton.limits[joint];
    const auto& channels = skeleton.channels[joint];
    if (stated.size() != channels.size() || stated.empty()) continue;
    EulerLimits euler;
    euler.part = part;
    euler.name = skeleton.names[joint];
    euler.order = skeleton.rotation_order(joint);
    std::size_t axis = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (is_rotation(channels[c])) euler.angles[axis++] = stated[c];
    }
    euler.before = conjugate(match.before[part]) * layout.references[part];
    euler.after = conjugate(match.after[part]);
    if (euler.order.count > 0) limits.joints.push_back(std::move(euler));
  }
  return limits;
}

std::vector<std::string> widen_joint_limits(JointLimits& limits, const PoseMatrix& poses) {
  std::vector<std::string> moved;
  if (poses.frames == 0) return moved;
  for (std::size_t d = 0; d < limits.channels.size(); ++d) {
    std::vector<double> values;
    for (std::size_t f = 0; f < poses.frames; ++f) values.push_back(poses(f, d));
    widen(limits.channels[d], values);
  }
  for (EulerLimits& joint : limits.joints) {
    std::array<std::vector<double>, 3> angles;
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const Angles at = angles_of(local_of(vector_at(poses, f, joint.part), joint), joint);
      for (std::size_t i = 0; i < joint.order.count; ++i)
        angles[i].push_back(at[i] * degrees_per_radian);
    }
    double most = 0;
    for (std::size_t i = 0; i < joint.order.count; ++i)
      most = std::max(most, widen(joint.angles[i], angles[i]));
    joint.order.count = most > far_deg ? 0 : joint.order.count;
    if (most > 0) moved.push_back(fmt::format("{} by {:.0f} degrees", joint.name, most));
  }
  std::erase_if(limits.joints, [](const EulerLimits& joint) { return joint.order.count == 0; });
  return moved;
}

void project_to_limits(const JointLimits& limits, const PoseMatrix& poses, PoseMatrix& nearest) {
  nearest = poses;
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t d = 0; d < limits.channels.size(); ++d) {
      nearest(f, d) =
          std::clamp(nearest(f, d), limits.channels[d].minimum, limits.channels[d].maximum);
    }
    for (const EulerLimits& joint : limits.joints) {
      Vec3 channels = vector_at(nearest, f, joint.part);
      if (!clamped(channels, joint)) continue;
      nearest(f, 3 * joint.part) = channels.x;
      nearest(f, 3 * joint.part + 1) = channels.y;
      nearest(f, 3 * joint.part + 2) = channels.z;
    }
  }
}

}  // namespace kinemend
