// Takes the first frames off a clip while work is done on the others, and puts them back.
#include "motion/calibration.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace kinemend {

namespace {

template <class T>
void take_front(std::vector<T>& values, std::size_t count) {
  if (!values.empty())
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

Clip take_front(Clip& clip, std::size_t frames) {
  const std::size_t joints = clip.joint_count(), points = clip.point_count();
  Clip front = slice(clip, 0, frames);
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

// No mask at all means that everything is observed.
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

void put_front(Clip& clip, const Clip& front) {
  const std::size_t tracks = 1 + clip.translated_joints.size();
  put_mask(clip.observed, clip.rotations.size(), front.observed, front.rotations.size());
  put_mask(clip.observed_positions, clip.frame_count() * tracks, front.observed_positions,
           front.frame_count() * tracks);
  put_front(clip.positions, front.positions);
  put_front(clip.rotations, front.rotations);
}

}  // namespace

void on_motion(Clip& clip, std::size_t frames, const std::function<void(Clip&)>& work) {
  if (frames == 0) return work(clip);
  const Clip front = take_front(clip, frames);
  try {
    work(clip);
  } catch (...) {
    put_front(clip, front);
    throw;
  }
  put_front(clip, front);
}

const Clip& frames_from(const Clip& clip, std::size_t first, std::optional<Clip>& sliced) {
  return first == 0 ? clip : sliced.emplace(slice(clip, first, clip.frame_count()));
}

}  // namespace kinemend
