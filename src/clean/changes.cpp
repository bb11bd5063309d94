#include "clean/changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "clean/tracks.hpp"

namespace kinemend {

namespace {

// Smaller changes are rounding errors: the sample keeps its input value, and its digits.
constexpr double least_change_rad = 1e-9 * radians_per_degree;
constexpr double least_shift = 1e-11;  // of a typical bone's length

// One joint's way through the frames.
struct JointBlend {
  RotationOrder order;
  double most_change_rad = pi;
  std::array<double, 3> angles{};  // of the frame before, for joints of one or two axes
};

Quat turned_towards(Quat from, Quat to, double weight, double limit) {
  const Vec3 turn = log(conjugate(from) * to);
  const double angle = norm(turn);
  const double share = angle * weight > limit ? limit / angle : weight;
  return normalized(from * exp(share * turn));
}

// The same along the joint's own axes, so that its channels can hold the result.
Quat turned_within_axes(Quat from, Quat to, double weight, double limit, JointBlend& joint) {
  const auto start = to_euler_near(from, joint.order, joint.angles);
  const auto end = to_euler_near(to, joint.order, start);
  joint.angles = start;
  const auto at = [&](double share) {
    std::array<double, 3> angles{};
    for (std::size_t i = 0; i < joint.order.count; ++i) {
      angles[i] = start[i] + share * (end[i] - start[i]);
    }
    return from_euler(angles, joint.order);
  };
  constexpr double rounding = 1 + 1e-12;
  double share = weight;
  Quat result = at(share);
  for (int step = 0; step < 50; ++step) {
    const double angle = angle_between(from, result);
    if (angle <= limit * rounding) return result;
    share *= limit / angle;
    result = at(share);
  }
  return from;
}

Action action_of(const std::vector<Action>& actions, std::size_t sample, bool changed) {
  const Action stated = actions.empty() ? Action::kept : actions[sample];
  if (!changed) return stated == Action::refused ? stated : Action::kept;
  return stated == Action::kept || stated == Action::refused ? Action::denoised : stated;
}

void blend_joint(const Clip& input, std::size_t first_frame, std::size_t joint,
                 const CleanSettings& settings, const std::vector<double>& weights,
                 const CleanTrace& trace, Clip& cleaned, Changes& changes) {
  JointBlend blend{
      input.skeleton.rotation_order(joint), settings.max_change_deg * radians_per_degree, {}};
  const bool all_axes = blend.order.count == 3;
  const std::size_t joints = input.joint_count();
  for (std::size_t f = 0; f < weights.size(); ++f) {
    const Quat from = input.rotation(first_frame + f, joint);
    Quat& result = cleaned.rotation(f, joint);
    double angle = 0;
    if (weights[f] > 0 && result != from) {
      const double limit =
          input.is_observed(first_frame + f, joint) ? blend.most_change_rad : 2 * pi;
      angle = angle_between(from, result);
      if (!all_axes) {
        result = turned_within_axes(from, result, weights[f], limit, blend);
        angle = angle_between(from, result);
      } else if (weights[f] < 1 || angle > limit) {
        result = turned_towards(from, result, weights[f], limit);
        angle = std::min(angle * weights[f], limit);
      }
    }
    if (angle < least_change_rad) result = from, angle = 0;
    changes.degrees[f * joints + joint] = angle * degrees_per_radian;
    changes.actions[f * joints + joint] = action_of(trace.actions, f * joints + joint, angle > 0);
  }
}

std::array<bool, 3> position_axes(const Skeleton& skeleton, std::size_t joint) {
  std::array<bool, 3> axes{};
  for (const Channel channel : skeleton.channels[joint]) {
    if (!is_rotation(channel)) axes[static_cast<std::size_t>(axis_of(channel))] = true;
  }
  return axes;
}

// Blends one position and returns how far it moved. Axes without a channel stay.
double blend_position(Vec3 from, Vec3& to, double weight, std::array<bool, 3> axes, double least) {
  Vec3 shift = weight * (to - from);
  if (!axes[0]) shift.x = 0;
  if (!axes[1]) shift.y = 0;
  if (!axes[2]) shift.z = 0;
  const double distance = norm(shift);
  if (distance < least) {
    to = from;
    return 0;
  }
  const Vec3 result = weight < 1 ? from + shift : to;
  to = {axes[0] ? result.x : from.x, axes[1] ? result.y : from.y, axes[2] ? result.z : from.z};
  return distance;
}

void blend_root(const Clip& input, std::size_t first_frame, const Selection& selection,
                const std::vector<double>& weights, const CleanTrace& trace, Clip& cleaned,
                Changes& changes) {
  const auto axes = position_axes(input.skeleton, 0);
  const double least = least_shift * typical_bone_length(input.skeleton);
  for (std::size_t f = 0; f < weights.size(); ++f) {
    const double weight = selection.root_position ? weights[f] : 0;
    changes.root[f] = blend_position(input.root_positions[first_frame + f],
                                     cleaned.root_positions[f], weight, axes, least);
    changes.root_actions[f] = action_of(trace.root_actions, f, changes.root[f] > 0);
  }
}

void blend_translations(const Clip& input, std::size_t first_frame, const Selection& selection,
                        const std::vector<double>& weights, Clip& cleaned) {
  const double least = least_shift * typical_bone_length(input.skeleton);
  const std::size_t width = input.translated_joints.size();
  for (std::size_t i = 0; i < width; ++i) {
    const auto axes = position_axes(input.skeleton, input.translated_joints[i]);
    const bool selected = translation_selected(input, selection, i);
    for (std::size_t f = 0; f < weights.size(); ++f) {
      blend_position(input.joint_translations[(first_frame + f) * width + i],
                     cleaned.joint_translations[f * width + i], selected ? weights[f] : 0, axes,
                     least);
    }
  }
}

double smooth_step(double x) { return x * x * (3 - 2 * x); }

}  // namespace

std::vector<double> frame_weights(const CleanSettings& settings, std::size_t frames,
                                  std::size_t first_frame, double frame_rate_hz) {
  std::vector<double> weights(frames - first_frame, settings.strength);
  if (!settings.range) return weights;
  constexpr double slope_s = 0.1;
  const auto [first, last] = *settings.range;
  const auto slope = static_cast<double>(frames_in(slope_s, frame_rate_hz, 0) + 1);
  for (std::size_t f = first_frame; f < frames; ++f) {
    double share = f >= first && f <= last ? 1.0 : 0.0;
    if (share > 0 && first > first_frame) {
      share = std::min(share, static_cast<double>(f - first + 1) / slope);
    }
    if (share > 0 && last + 1 < frames) {
      share = std::min(share, static_cast<double>(last - f + 1) / slope);
    }
    weights[f - first_frame] *= smooth_step(share);
  }
  return weights;
}

Changes blend_changes(const Clip& input, std::size_t first_frame, const Selection& selection,
                      const CleanSettings& settings, const std::vector<double>& weights,
                      const CleanTrace& trace, Clip& cleaned) {
  const std::size_t joints = input.joint_count(), frames = weights.size();
  Changes changes;
  changes.degrees.assign(frames * joints, 0);
  changes.actions.assign(frames * joints, Action::kept);
  changes.root.assign(frames, 0);
  changes.root_actions.assign(frames, Action::kept);
  const std::vector<double> nothing(frames, 0.0);
  for_each_parallel(joints, joints * frames, [&](std::size_t j) {
    // The rotation of a joint without rotation channels has no place in a file.
    const bool may_turn = selection.joints[j] && input.skeleton.rotation_order(j).count > 0;
    blend_joint(input, first_frame, j, settings, may_turn ? weights : nothing, trace, cleaned,
                changes);
  });
  blend_root(input, first_frame, selection, weights, trace, cleaned, changes);
  blend_translations(input, first_frame, selection, weights, cleaned);
  return changes;
}

}  // namespace kinemend
