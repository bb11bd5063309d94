// Finds jumps of Euler angles in a file: whole turns, other branches, and gimbal lock.
#include <algorithm>
#include <array>
#include <cmath>

#include "check/checks.hpp"

namespace kinemend::check {

namespace {

// The rotation channels of one joint among the columns of the file.
struct AngleColumns {
  std::size_t joint = 0;
  std::array<std::size_t, 3> columns{};
  RotationOrder order;
};

std::vector<AngleColumns> angle_columns(const Skeleton& skeleton) {
  std::vector<AngleColumns> list;
  std::size_t column = 0;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    AngleColumns angles{j, {}, skeleton.rotation_order(j)};
    std::size_t found = 0;
    for (const Channel channel : skeleton.channels[j]) {
      if (is_rotation(channel) && found < angles.columns.size()) angles.columns[found++] = column;
      ++column;
    }
    if (found > 0) list.push_back(angles);
  }
  return list;
}

std::size_t channel_count(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const auto& channels : skeleton.channels) count += channels.size();
  return count;
}

enum class Leap : std::uint8_t { none, whole_turn, other_branch, gimbal_lock };

struct LeapSize {
  Leap leap = Leap::none;
  double degrees = 0;
};

// Returns the degrees from the middle angle to the nearest gimbal lock.
double to_gimbal_lock(double middle, RotationOrder order) {
  const bool repeats_axis = order.axes[0] == order.axes[2];
  return std::fabs(wrap_angle(middle - (repeats_axis ? 0 : 90), 90));
}

LeapSize leap_of(const double* before, const double* now, const AngleColumns& joint,
                 double turn_deg) {
  // The degrees of a leap, the largest share of it that the joint turns, and the degrees from
  // gimbal lock. Chosen by hand, not swept.
  constexpr double large = 90, share_of_leap = 0.25, near_lock = 8;
  LeapSize result;
  double whole = 0, wrapped = 0;
  for (std::size_t i = 0; i < joint.order.count; ++i) {
    const double step = now[joint.columns[i]] - before[joint.columns[i]];
    if (!std::isfinite(step)) return result;
    whole = std::max(whole, std::fabs(step));
    wrapped = std::max(wrapped, std::fabs(wrap_angle(step, 180)));
  }
  if (wrapped > large && turn_deg < share_of_leap * wrapped) {
    result = {Leap::other_branch, wrapped};
    const std::size_t middle = joint.columns[1];
    if (joint.order.count == 3 && std::min(to_gimbal_lock(before[middle], joint.order),
                                           to_gimbal_lock(now[middle], joint.order)) < near_lock)
      result.leap = Leap::gimbal_lock;
  } else if (whole > 180 && turn_deg < share_of_leap * whole) {
    result = {Leap::whole_turn, whole};
  }
  return result;
}

}  // namespace

void check_euler_flips(const Take& clip, CheckReport& report) {
  const std::size_t frames = clip.frame_count(), width = channel_count(clip.skeleton);
  if (clip.source.document == nullptr || frames == 0) return;
  const std::vector<double> values = clip.source.document->channel_values();
  if (values.empty() || values.size() != frames * width) return;
  static constexpr std::array<const char*, 4> words{
      "", "has an angle that jumps by a full turn although the joint does not move",
      "has angles that change to others of the same rotation",
      "has angles that jump at a gimbal lock"};
  for (const AngleColumns& joint : angle_columns(clip.skeleton)) {
    for (std::size_t t = report.calibration_frames + 1; t < frames; ++t) {
      const double turn = degrees_per_radian * angle_between(clip.rotation(t - 1, joint.joint),
                                                             clip.rotation(t, joint.joint));
      const LeapSize leap =
          leap_of(values.data() + (t - 1) * width, values.data() + t * width, joint, turn);
      if (leap.leap == Leap::none) continue;
      ++report.tracks[joint.joint].flips;
      ++report.figures.flips;
      report.findings.push_back({FindingKind::euler_flip, Severity::note,
                                 clip.skeleton.names[joint.joint], t, t, leap.degrees, "deg",
                                 words[static_cast<std::size_t>(leap.leap)]});
    }
  }
}

}  // namespace kinemend::check
