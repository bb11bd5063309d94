// Finds the calibration pose at the start of a take of joints.
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

Turn turn_between(const Take& clip, std::size_t first, std::size_t second) {
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
bool is_near_rest(const Take& clip, std::size_t frame) {
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
double usual_step(const Take& clip, std::size_t first, std::size_t last) {
  std::vector<double> steps;
  for (std::size_t f = first; f + 1 < last; ++f) steps.push_back(turn_between(clip, f, f + 1).mean);
  return of_rank(steps, (steps.size() - 1) * 9 / 10);
}

}  // namespace

std::size_t leading_calibration_frames(const Take& clip) {
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
