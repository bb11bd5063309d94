// Predicts a marker from its companions, or a joint's rotation from those of the other joints, by
// ridge regression on other frames of the take.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "base/frame_span.hpp"
#include "fill/samples.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The training frames of a regression, which can leave out those of any span.
struct TrainingRows {
  std::vector<std::size_t> frames;  ///< ascending
  Rows rows;                        ///< frames x (1, further columns)
  Rows sums;                        ///< rows^T rows

  /// Returns the sums of products of these columns over the frames outside the span.
  template <class Columns>
  Rows sums_without(FrameSpan span, const Columns& columns) const {
    const auto first = std::lower_bound(frames.begin(), frames.end(), span.first);
    const auto last = std::upper_bound(first, frames.end(), span.last);
    Rows kept = sums(columns, columns);
    if (first == last) return kept;
    const Rows hidden = rows.middleRows(first - frames.begin(), last - first)(Eigen::all, columns);
    kept.noalias() -= hidden.transpose() * hidden;
    return kept;
  }
};

/// Ridge regression of three outputs y on inputs x:
///
///     B = argmin |Y - X B|^2 + n stiffness^2 |B|^2,      y = mean(Y) + (x - mean(X)) B.
///
/// `sums`: of products of (1, x, y) over the training frames. Predicts y for each row of `inputs`
/// and each stiffness (in the unit of x; with infinity y is its mean).
std::vector<Rows> ridge_regression(const Rows& sums, const Rows& inputs,
                                   std::span<const double> stiffness);

/// Carries the errors of a guess at the observed frames beside a gap into the gap, so that the
/// corrected guess meets both ends in value and velocity. The correction is the mean of a Gaussian
/// process through these errors (Rasmussen & Williams 2006, eq. 2.23). Most of a pose guess's error
/// has lasted for a while, so the process is a sum of two: a fast one with Matern's covariance of
/// nu = 5/2 and the given memory, and a slower one of nu = 3/2. Far from both ends the guess is
/// left unchanged.
class Bridge {
 public:
  struct Settings {
    double memory_s = 0.083;  ///< memory of the fast part
    /// Variance of the samples' noise as a share of the errors' variance. The samples next to the
    /// gap are met whatever its value.
    double noise = 1e-4;
  };

  /// `beside`: observed frames next to the span, ascending. `wanted`: the requested frames of the
  /// span.
  Bridge(std::span<const std::size_t> beside, FrameSpan span, std::span<const std::size_t> wanted,
         double frame_rate_hz, const Settings& settings);

  /// Returns the errors (sample minus guess) at `wanted`, given those at `beside`.
  std::vector<Vec3> carry(std::span<const Vec3> errors) const;

 private:
  std::size_t wanted_, beside_;
  std::vector<double> weights_;  // wanted x beside
};

/// Predicts a marker from its companions: the markers that keep their distance to it. In the frame
/// of reference that moves with the companions, `ridge_regression` predicts the marker's
/// coordinates from theirs, over the frames of the take in which all are seen. Rows hold three
/// coordinates, or those of all companions. With infinite stiffness the companions and the marker
/// are one rigid body.
class LocalRegression {
 public:
  /// Learns from at most 192 frames outside the gap, with the first `most_companions` of the given
  /// ones (`companions_of`).
  LocalRegression(const Samples& samples, const MarkerGap& gap,
                  std::span<const Companion> companions, std::size_t most_companions);

  /// Whether there are companions and enough frames to learn from.
  bool usable() const { return training_.frames.size() >= least_training_frames; }
  const MarkerGroup& group() const { return group_; }

  /// A span of the take to predict: its companions' samples, and the marker's samples beside it.
  struct Scene {
    FrameSpan span = {};
    std::vector<std::size_t> beside;  ///< observed frames near the span, ascending
    std::vector<std::size_t> wanted;  ///< frames of the span
    std::vector<Placement> placed;    ///< placements of the frames beside, then of the wanted ones
    Rows inputs;  ///< in the same order: the companions' coordinates about their shape
    Rows seen;    ///< the marker's own coordinates in the frames beside
  };
  /// `gap`: of the same marker.
  Scene scene_of(const MarkerGap& gap, std::span<const std::size_t> wanted) const;

  /// Returns the marker's coordinates in all frames of the scene for each stiffness (file units;
  /// infinity: rigid), by regression on the frames outside its span.
  std::vector<Rows> predict(const Scene& scene, std::span<const double> stiffness) const;
  /// Returns the bridge that carries errors beside the scene's span into it.
  Bridge bridge_of(const Scene& scene, const Bridge::Settings& settings = {}) const;
  /// Returns positions in the wanted frames: the coordinates, moved so that they meet the ends.
  static std::vector<Vec3> meet_ends(const Scene& scene, const Bridge& bridge,
                                     const Rows& coordinates);

  /// The companions' coordinates about their shape, and the marker's, in the training frames.
  Rows training_inputs() const;
  Rows training_outputs() const;

  // Not swept.
  static constexpr std::size_t least_training_frames = 8;  // fewer cannot test a model

 private:
  Placement put_inputs(std::size_t frame, double* row) const;
  void learn();
  Eigen::Index inputs() const { return static_cast<Eigen::Index>(3 * group_.markers().size()); }

  const Samples& samples_;
  std::size_t marker_;
  MarkerGroup group_;
  TrainingRows training_;  // columns: 1, inputs, outputs
};

/// Returns the stiffnesses as shares of the body's radius; the last is rigid. Chosen on the takes
/// that docs/measured/fill.md names.
inline std::array<double, 3> stiffnesses_of(double radius) {
  return {0.0015 * radius, 0.008 * radius, std::numeric_limits<double>::infinity()};
}

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
