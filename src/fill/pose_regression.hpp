// Predicts a joint's rotation from those of the other joints.
#pragma once

#include <cstddef>
#include <vector>

#include "fill/ridge.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

/// Predicts one joint's rotation from those of the other joints in the same frame, by
/// `ridge_regression` learned from the frames of the take in which all are observed (after Gloersen
/// & Federolf 2016, who predict markers). Inputs and outputs are rotation vectors about each
/// joint's mean.
class PoseRegression {
 public:
  /// Learns from at most 1500 of the clip's frames, evenly chosen.
  explicit PoseRegression(const Take& clip);

  /// Returns rotations of `joint` in the frames [first, last], predicted from the joints that are
  /// observed in all of these frames; the joint's own rotations inside the span are never read.
  /// Empty if too little is observed: fewer than four other joints, or less of the take to learn
  /// from than 0.5 s or the length of the span.
  std::vector<Quat> predict(std::size_t joint, FrameSpan span, std::size_t first,
                            std::size_t last) const;

 private:
  Vec3 vector_of(std::size_t frame, std::size_t joint) const;
  std::vector<std::size_t> predictors_of(std::size_t joint, std::size_t first,
                                         std::size_t last) const;

  const Take& clip_;
  std::size_t step_ = 1;                // between training frames
  std::vector<Quat> means_;             // J
  std::vector<std::uint8_t> usable_;    // J: its rotations are close enough to their mean
  std::vector<std::uint8_t> predicts_;  // J: usable as an input for others
  TrainingRows training_;               // whole frames; columns: 1, one vector per joint
};

}  // namespace kinemend::fill
