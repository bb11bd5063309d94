// Samples the channels of both takes and rounds them to quanta.
#include "report/page/channels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

namespace kinemend::page {

namespace {

/// One value for each stored frame.
using Values = std::vector<double>;

double largest_of(const Values& values) {
  double largest = 0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
  }
  return largest;
}

void add(const Values& before, const Values& after, double quantum, Channels& channels) {
  const double used = quantum_for(quantum, std::max(largest_of(before), largest_of(after)));
  channels.samples.push_back({quantised(before, used), quantised(after, used)});
  channels.quanta.push_back(used);
}

Channels empty_channels(std::size_t frames, std::size_t count) {
  Channels channels;
  channels.step = frame_step(frames, count);
  channels.frames = (frames + channels.step - 1) / channels.step;
  return channels;
}

void append(Channels more, Channels& channels) {
  std::move(more.samples.begin(), more.samples.end(), std::back_inserter(channels.samples));
  channels.quanta.insert(channels.quanta.end(), more.quanta.begin(), more.quanta.end());
}

using PositionAt = std::function<Vec3(std::size_t frame)>;

std::array<Values, 3> positions(const Channels& channels, const PositionAt& at) {
  std::array<Values, 3> axes;
  for (std::size_t f = 0; f < channels.frames; ++f) {
    const Vec3 p = at(f * channels.step);
    axes[0].push_back(p.x);
    axes[1].push_back(p.y);
    axes[2].push_back(p.z);
  }
  return axes;
}

// `after` is empty if there is one take.
void add_positions(const PositionAt& before, const PositionAt& after, double quantum,
                   Channels& channels) {
  const auto old_values = positions(channels, before);
  const auto new_values = after ? positions(channels, after) : std::array<Values, 3>();
  for (std::size_t axis = 0; axis < 3; ++axis)
    add(old_values[axis], new_values[axis], quantum, channels);
}

PositionAt position_of(const Take* clip, std::size_t track) {
  if (clip == nullptr) return {};
  return [clip, track](std::size_t frame) { return clip->position(frame, track); };
}

void add_rotation(const Take& before, const Take* after, std::size_t joint, RotationOrder order,
                  double quantum_deg, Channels& channels) {
  std::array<Values, 3> old_angles, new_angles;
  std::array<double, 3> angles{};
  for (std::size_t f = 0; f < before.frame_count(); f += channels.step) {
    angles = to_euler_near(before.rotation(f, joint), order, angles);
    for (std::size_t a = 0; a < order.count; ++a)
      old_angles[a].push_back(angles[a] * degrees_per_radian);
    if (after == nullptr) continue;
    const auto other = to_euler_near(after->rotation(f, joint), order, angles);
    for (std::size_t a = 0; a < order.count; ++a)
      new_angles[a].push_back(other[a] * degrees_per_radian);
  }
  for (std::size_t a = 0; a < order.count; ++a)
    add(old_angles[a], new_angles[a], quantum_deg, channels);
}

bool turns(const Take& clip, std::size_t joint) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (angle_between(clip.rotation(f, joint), Quat{}) > 1e-9) return true;
  }
  return false;
}

PositionAt held_position_of(const Take* clip, std::size_t marker) {
  if (clip == nullptr) return {};
  return [clip, marker, last = Vec3()](std::size_t frame) mutable {
    if (clip->is_observed(frame, marker)) last = clip->position(frame, marker);
    return last;
  };
}

}  // namespace

double position_quantum(double body_height) { return body_height > 0 ? body_height / 17000 : 1e-4; }

std::size_t frame_step(std::size_t frames, std::size_t channels) {
  return std::max<std::size_t>(1, (frames * channels + most_samples - 1) / most_samples);
}

std::size_t part_stride(std::size_t frames, std::size_t channels) {
  return frames * channels > most_samples_at_once ? stride_of_parts : 1;
}

std::size_t channel_count(const Take& take) {
  std::size_t count = 3 * take.point_count();
  for (std::size_t j = 0; j < take.joint_count(); ++j)
    count += take.skeleton.rotation_order(j).count;
  return count;
}

RotationOrder told_order(const Take& before, const Take* after, std::size_t joint) {
  const RotationOrder order = before.skeleton.rotation_order(joint);
  if (order.count > 0) return order;
  const bool does_turn = turns(before, joint) || (after != nullptr && turns(*after, joint));
  return does_turn ? parse_rotation_order("ZXY") : order;
}

Channels channels_of(const Take& before, const Take* after, double body_height, double share) {
  Channels channels = empty_channels(before.frame_count(), channel_count(before));
  const double quantum = share * position_quantum(body_height);
  const bool joints = before.has_joints();
  std::vector<Channels> of_joints(before.joint_count(), channels);
  for (std::size_t p = 0; p < before.point_count(); ++p) {
    if (joints)
      add_positions(position_of(&before, p), position_of(after, p), quantum, channels);
    else
      add_positions(held_position_of(&before, p), held_position_of(after, p), quantum, channels);
  }
  for_each_parallel(of_joints.size(), of_joints.size() * channels.frames, [&](std::size_t j) {
    add_rotation(before, after, j, told_order(before, after, j), share * rotation_quantum_deg,
                 of_joints[j]);
  });
  for (Channels& joint : of_joints) append(std::move(joint), channels);
  return channels;
}

}  // namespace kinemend::page
