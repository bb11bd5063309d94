#include "kinemend/clip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "motion/clip_checks.hpp"

namespace kinemend {

namespace {

struct Turn {
  double mean = 0, largest = 0;  // over joints
};

Turn turn_between(const Clip& clip, std::size_t first, std::size_t second) {
  Turn turn;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const double angle = angle_between(clip.rotation(first, j), clip.rotation(second, j));
    turn.mean += angle / static_cast<double>(clip.joint_count());
    turn.largest = std::max(turn.largest, angle);
  }
  return turn;
}

// The pose of a calibration frame: roots may be turned, joints are nearly at rest. The T-pose
// of the CMU files turns hips and feet by up to 21 degrees, 3.5 on average.
bool is_near_rest(const Clip& clip, std::size_t frame) {
  constexpr double largest = 25 * radians_per_degree, largest_mean = 6 * radians_per_degree;
  double sum = 0;
  std::size_t joints = 0;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (clip.skeleton.parents[j] < 0) continue;
    const double angle = angle_between(clip.rotation(frame, j), Quat{});
    if (angle > largest) return false;
    sum += angle;
    ++joints;
  }
  return sum <= largest_mean * static_cast<double>(joints);
}

// 90 % quantile of the joints' mean turn per step, from `first` on.
double usual_step(const Clip& clip, std::size_t first, std::size_t last) {
  std::vector<double> steps;
  for (std::size_t f = first; f + 1 < last; ++f) steps.push_back(turn_between(clip, f, f + 1).mean);
  return of_rank(steps, (steps.size() - 1) * 9 / 10);
}

}  // namespace

void Clip::validate() const {
  skeleton.validate();
  check_frame_rate(frame_rate_hz);
  const std::size_t frames = frame_count(), joints = joint_count();
  check_length(local_rotations.size(), frames * joints, "local rotations");
  check_length(joint_translations.size(), frames * translated_joints.size(), "joint translations");
  if (!observed.empty()) check_length(observed.size(), frames * joints, "observed mask");
  if (!observed_positions.empty()) {
    check_length(observed_positions.size(), frames * (1 + translated_joints.size()),
                 "mask of observed positions");
  }
  for (std::size_t i = 0; i < translated_joints.size(); ++i) {
    const bool ascending = i == 0 || translated_joints[i] > translated_joints[i - 1];
    if (translated_joints[i] < 1 || translated_joints[i] >= static_cast<std::int32_t>(joints) ||
        !ascending) {
      throw Error(ErrorKind::usage, "translated joints are not ascending joint numbers above 0");
    }
  }
  for (std::size_t f = 0; f < frames; ++f) {
    if (!is_finite(root_positions[f]))
      throw Error(ErrorKind::usage, fmt::format("frame {}: root position is not finite", f));
    for (std::size_t j = 0; j < joints; ++j) {
      if (!(std::fabs(norm(rotation(f, j)) - 1) <= 1e-6)) {
        throw Error(ErrorKind::usage,
                    fmt::format("frame {}, joint \"{}\": rotation is not a unit quaternion", f,
                                skeleton.names[j]));
      }
    }
  }
  if (!std::all_of(joint_translations.begin(), joint_translations.end(), is_finite)) {
    throw Error(ErrorKind::usage, "a joint translation is not finite");
  }
}

Clip slice(const Clip& clip, std::size_t first, std::size_t last) {
  const auto rows = [&](const auto& values, std::size_t width) {
    using Values = std::decay_t<decltype(values)>;
    if (values.empty()) return Values{};
    return Values(values.begin() + static_cast<std::ptrdiff_t>(first * width),
                  values.begin() + static_cast<std::ptrdiff_t>(last * width));
  };
  Clip result;
  result.skeleton = clip.skeleton;
  result.frame_rate_hz = clip.frame_rate_hz;
  result.metres_per_unit = clip.metres_per_unit;
  result.root_positions = rows(clip.root_positions, 1);
  result.local_rotations = rows(clip.local_rotations, clip.joint_count());
  result.translated_joints = clip.translated_joints;
  result.joint_translations = rows(clip.joint_translations, clip.translated_joints.size());
  result.observed = rows(clip.observed, clip.joint_count());
  result.observed_positions = rows(clip.observed_positions, 1 + clip.translated_joints.size());
  result.source.name = clip.source.name;
  return result;
}

std::size_t leading_calibration_frames(const Clip& clip) {
  constexpr std::size_t most_frames = 10, compared_frames = 240;
  constexpr double clear_jump = 25 * radians_per_degree, clear_ratio = 1.5;
  const std::size_t frames = std::min(clip.frame_count(), compared_frames);
  std::size_t count = 0;
  while (count < most_frames && count < frames && is_near_rest(clip, count)) ++count;
  if (count == 0 || count == most_frames || count + 2 > frames) return 0;
  // Motion that starts from the rest pose accelerates over several frames; after a calibration pose
  // one step is an outlier. Means over joints and a percentile of the steps make this robust to
  // noise.
  const Turn jump = turn_between(clip, count - 1, count);
  const double next = turn_between(clip, count, count + 1).mean;
  const double usual = usual_step(clip, count, frames);
  const bool stands_out =
      jump.largest > clear_jump && jump.mean > clear_ratio * std::max(next, usual);
  return stands_out ? count : 0;
}

}  // namespace kinemend
