#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fill/curves.hpp"
#include "kinemend/clip.hpp"

namespace kinemend::fill {

/// Predicts one joint's rotation from those of the other joints of the same frame, as learned from
/// the frames of the take in which all are observed (after Gloersen & Federolf 2016, who predict
/// markers): with x the other joints' rotation vectors about their means and y the joint's,
///
///     B = argmin |Y - X B|^2 + n stiffness^2 |B|^2,     y = mean(Y) + (x - mean(X)) B.
class PoseRegression {
 public:
  /// At most `most_frames` of the clip's frames, evenly chosen, are learned from.
  explicit PoseRegression(const Clip& clip, std::size_t most_frames = 1500);

  /// Rotations of `joint` in the frames [first, last], predicted from the joints that are observed
  /// in all of these frames; no rotation of the joint inside the span is looked at. None where too
  /// little is observed: fewer than `least_joints` others, or fewer frames to learn from than 1 s
  /// and twice the span. `stiffness` in radians.
  std::vector<Quat> predict(std::size_t joint, FrameSpan span, std::size_t first, std::size_t last,
                            double stiffness) const;

  static constexpr std::size_t least_joints = 4;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Vec3 vector_of(std::size_t frame, std::size_t joint) const;
  std::vector<std::size_t> predictors_of(std::size_t joint, std::size_t first,
                                         std::size_t last) const;
  Rows sums_without(FrameSpan span, const std::vector<Eigen::Index>& columns,
                    std::size_t& count) const;

  const Clip& clip_;
  std::size_t step_ = 1;                // between frames learned from
  std::vector<Quat> means_;             // J
  std::vector<std::uint8_t> usable_;    // J: its rotations are near enough to their mean
  std::vector<std::uint8_t> predicts_;  // J: of use for others
  Rows rows_;                           // frames x (1, three vectors a joint), whole frames only
  std::vector<std::size_t> frames_;     // of the rows
  Rows sums_;                           // rows^T rows
};

}  // namespace kinemend::fill
