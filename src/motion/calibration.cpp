// Finds the calibration pose at the start of a take, and removes it while work is done on the
// motion.
#include "motion/calibration.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/quantiles.hpp"

namespace kinemend {

namespace {

template <class T>
void take_front(std::vector<T>& values, std::size_t count) {
  if (!values.empty())
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

Take take_front(Take& clip, std::size_t frames) {
  const std::size_t joints = clip.joint_count(), points = clip.point_count();
  Take front = slice(clip, 0, frames);
  take_front(clip.rotations, frames * joints);
  take_front(clip.positions, frames * points);
  take_front(clip.observed, frames * joints);
  take_front(clip.observed_positions, frames * points);
  return front;
}

template <class T>
void put_front(std::vector<T>& values, const std::vector<T>& front) {
  values.insert(values.begin(), front.begin(), front.end());
}

// Puts the mask of the front frames back. An empty mask means that all samples are observed.
void put_mask(std::vector<std::uint8_t>& mask, std::size_t samples,
              const std::vector<std::uint8_t>& front, std::size_t front_samples) {
  if (mask.empty() && std::find(front.begin(), front.end(), 0) == front.end()) return;
  if (mask.empty()) mask.assign(samples, 1);
  if (front.empty()) {
    mask.insert(mask.begin(), front_samples, 1);
  } else {
    put_front(mask, front);
  }
}

void put_front(Take& clip, const Take& front) {
  const std::size_t tracks = 1 + clip.translated_joints.size();
  put_mask(clip.observed, clip.rotations.size(), front.observed, front.rotations.size());
  put_mask(clip.observed_positions, clip.frame_count() * tracks, front.observed_positions,
           front.frame_count() * tracks);
  put_front(clip.positions, front.positions);
  put_front(clip.rotations, front.rotations);
}

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
  // Chosen by hand, above the angles in these files; not swept.
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

void on_motion(Take& clip, std::size_t frames, const std::function<void(Take&)>& work) {
  if (frames == 0) return work(clip);
  const Take front = take_front(clip, frames);
  try {
    work(clip);
  } catch (...) {
    put_front(clip, front);
    throw;
  }
  put_front(clip, front);
}

const Take& frames_from(const Take& clip, std::size_t first, std::optional<Take>& sliced) {
  return first == 0 ? clip : sliced.emplace(slice(clip, first, clip.frame_count()));
}

std::size_t leading_calibration_frames(const Take& clip) {
  // Limits for the frames of a calibration pose and for the compared frames; the least jump to the
  // motion, and its least ratio to the jumps within the motion. Chosen by hand, not swept.
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
