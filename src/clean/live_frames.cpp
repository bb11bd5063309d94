#include "clean/live_frames.hpp"

#include <algorithm>

#include "clean/clip_tracks.hpp"

namespace kinemend {

namespace {

// A copy, also of an empty array.
template <class T>
std::vector<T> row_of(const std::vector<T>& values, std::size_t row, std::size_t width) {
  if (values.empty()) return {};
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * width);
  return {first, first + static_cast<std::ptrdiff_t>(width)};
}

}  // namespace

LiveFrame frame_of(const Clip& clip, std::size_t frame) {
  LiveFrame live;
  live.root_position = clip.root_positions[frame];
  live.rotations = row_of(clip.local_rotations, frame, clip.joint_count());
  live.joint_translations = row_of(clip.joint_translations, frame, clip.translated_joints.size());
  live.observed = row_of(clip.observed, frame, clip.joint_count());
  return live;
}

CleanTrace clean_causally(const Cleaner& cleaner, Clip& clip, const Selection& selection) {
  CleanTrace trace;
  mark_gaps(clip, selected_joints(clip, selection), trace);
  const auto filter = cleaner.make_frame_filter(clip.skeleton, clip.frame_rate_hz);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    LiveFrame live = frame_of(clip, f);
    filter->filter(live);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (selection.joints[j]) clip.rotation(f, j) = live.rotations[j];
    }
    if (selection.root_position) clip.root_positions[f] = live.root_position;
    for (std::size_t i = 0; i < clip.translated_joints.size(); ++i) {
      if (!translation_selected(clip, selection, i)) continue;
      clip.joint_translations[f * clip.translated_joints.size() + i] = live.joint_translations[i];
    }
  }
  return trace;
}

}  // namespace kinemend
