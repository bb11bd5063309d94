#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// Frame `frame` of a clip as a live frame.
LiveFrame frame_of(const Clip& clip, std::size_t frame);

/// Runs the frame filter of a causal cleaner over the clip from its first frame to its last and
/// writes the selected parts back. Unobserved samples that are selected are marked as filled.
CleanTrace clean_causally(const Cleaner& cleaner, Clip& clip, const Selection& selection);

/// A frame filter that treats each joint and each position by itself: a copy of `rotation` or
/// `position` for every track, whose `step(sample, seen)` returns the cleaned sample.
template <class RotationStep, class PositionStep>
class TrackFrameFilter final : public FrameFilter {
 public:
  TrackFrameFilter(const Skeleton& skeleton, RotationStep rotation, PositionStep position)
      : position_(std::move(position)), rotations_(skeleton.joint_count(), std::move(rotation)) {}

  void filter(LiveFrame& frame) override {
    for (std::size_t j = 0; j < rotations_.size(); ++j) {
      const bool seen = frame.observed.empty() || frame.observed[j] != 0;
      frame.rotations[j] = rotations_[j].step(frame.rotations[j], seen);
    }
    positions_.resize(1 + frame.joint_translations.size(), position_);
    frame.root_position = positions_[0].step(frame.root_position, true);
    for (std::size_t i = 0; i < frame.joint_translations.size(); ++i) {
      frame.joint_translations[i] = positions_[i + 1].step(frame.joint_translations[i], true);
    }
  }

 private:
  PositionStep position_;
  std::vector<RotationStep> rotations_;
  std::vector<PositionStep> positions_;
};

}  // namespace kinemend
