#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "fill/marker_group.hpp"

namespace kinemend::fill {

struct LocalSettings {
  std::size_t companions = 8;  ///< markers that predict, at most
  std::size_t training_frames = 512;
  double memory_s = 0.08;  ///< of the errors at the ends
};

/// The place of a marker among the markers that keep their distance to it. In the frame of
/// reference that moves with these companions its coordinates y are predicted from theirs, x, by
/// ridge regression over the frames of the take in which all are seen:
///
///     B = argmin |Y - X B|^2 + n stiffness^2 |B|^2,      y = mean(Y) + (x - mean(X)) B.
///
/// With infinite stiffness the companions and the marker are one rigid body.
class LocalRegression {
 public:
  LocalRegression(const Samples& samples, const MarkerGap& gap,
                  std::span<const std::size_t> helpers, const LocalSettings& settings = {});

  /// Whether there are companions and frames to learn from.
  bool usable() const { return training_.size() >= least_training_frames; }
  const MarkerGroup& group() const { return group_; }
  /// Spread of the distances to the nearest three companions, or as many as there are.
  double rigidity() const { return rigidity_; }

  /// Positions at the frames `wanted` of the span for each of the stiffnesses (file units;
  /// infinity: rigid), none of the marker's samples in the span being used; they meet the ends.
  std::vector<std::vector<Vec3>> predict(Span span, std::span<const std::size_t> wanted,
                                         std::span<const double> stiffness) const;

  static constexpr std::size_t least_training_frames = 8;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Placement local_row(std::size_t frame, double* row) const;
  Rows sums_without(Span span, Eigen::Index& count) const;

  const Samples& samples_;
  std::size_t marker_;
  LocalSettings settings_;
  MarkerGroup group_;
  double rigidity_ = 0;
  std::vector<std::size_t> training_;
  Rows rows_;  // training frames x (1, companions' coordinates about the shape, the marker's)
  Rows sums_;  // rows^T rows
};

}  // namespace kinemend::fill
