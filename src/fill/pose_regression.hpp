// Predicts a joint's rotation from those of the other joints.
#pragma once

#include <cstddef>
#include <vector>

#include "fill/ridge.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

/// Predicts one joint's rotation from those of the other joints of the same frame, as learned by
/// `ridge_regression` from the frames of the take in which all are observed (after Gloersen &
/// Federolf 2016, who predict markers). Inputs and outputs are rotation vectors about each joint's
/// mean.
class PoseRegression {
 public:
  /// At most 1500 of the clip's frames, evenly chosen, are learned from.
  explicit PoseRegression(const Take& clip);

  /// Rotations of `joint` in the frames [first, last], predicted from the joints that are observed
  /// in all of these frames; no rotation of the joint inside the span is looked at. None where too
  /// little is observed: fewer than four other joints, or less of the take to learn from than
  /// 0.5 s or the length of the span.
  std::vector<Quat> predict(std::size_t joint, FrameSpan span, std::size_t first,
                            std::size_t last) const;

 private:
  Vec3 vector_of(std::size_t frame, std::size_t joint) const;
  std::vector<std::size_t> predictors_of(std::size_t joint, std::size_t first,
                                         std::size_t last) const;

  const Take& clip_;
  std::size_t step_ = 1;                // between frames learned from
  std::vector<Quat> means_;             // J
  std::vector<std::uint8_t> usable_;    // J: its rotations are near enough to their mean
  std::vector<std::uint8_t> predicts_;  // J: of use for others
  TrainingRows training_;               // whole frames; columns: 1, a vector a joint
};

}  // namespace kinemend::fill
