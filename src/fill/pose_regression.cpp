#include "fill/pose_regression.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace kinemend::fill {

namespace {

// A rotation vector about the mean is smooth up to half a turn; a root's heading says nothing of
// the pose, its lean does.
constexpr double farthest_from_mean = 150 * radians_per_degree;
constexpr double farthest_of_a_root = 45 * radians_per_degree;

Eigen::Index as_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

PoseRegression::PoseRegression(const Clip& clip, std::size_t most_frames) : clip_(clip) {
  const std::size_t frames = clip.frame_count(), joints = clip.joint_count();
  step_ = std::max<std::size_t>(1, (frames + most_frames - 1) / most_frames);
  means_.resize(joints);
  usable_.assign(joints, 0);
  predicts_.assign(joints, 0);
  std::vector<Quat> seen;
  for (std::size_t j = 0; j < joints; ++j) {
    if (clip.skeleton.rotation_order(j).count == 0) continue;
    seen.clear();
    for (std::size_t f = 0; f < frames; f += step_) {
      if (clip.is_observed(f, j)) seen.push_back(clip.rotation(f, j));
    }
    if (seen.empty()) continue;
    means_[j] = chordal_mean(seen);
    double farthest = 0;
    for (const Quat q : seen) farthest = std::max(farthest, angle_between(means_[j], q));
    const bool is_root = clip.skeleton.parents[j] < 0;
    usable_[j] = farthest < farthest_from_mean;
    predicts_[j] = usable_[j] && farthest > 0 && (!is_root || farthest < farthest_of_a_root);
  }
  for (std::size_t f = 0; f < frames; f += step_) {
    bool whole = true;
    for (std::size_t j = 0; j < joints && whole; ++j) whole = !usable_[j] || clip.is_observed(f, j);
    if (whole) frames_.push_back(f);
  }
  rows_ = Rows::Zero(as_index(frames_.size()), as_index(1 + 3 * joints));
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    double* row = &rows_(as_index(i), 0);
    row[0] = 1;
    for (std::size_t j = 0; j < joints; ++j) {
      if (!usable_[j]) continue;
      const Vec3 v = vector_of(frames_[i], j);
      row[1 + 3 * j] = v.x, row[2 + 3 * j] = v.y, row[3 + 3 * j] = v.z;
    }
  }
  sums_.noalias() = rows_.transpose() * rows_;
}

Vec3 PoseRegression::vector_of(std::size_t frame, std::size_t joint) const {
  return log(conjugate(means_[joint]) * clip_.rotation(frame, joint));
}

std::vector<std::size_t> PoseRegression::predictors_of(std::size_t joint, std::size_t first,
                                                       std::size_t last) const {
  std::vector<std::size_t> predictors;
  for (std::size_t j = 0; j < clip_.joint_count(); ++j) {
    if (j == joint || !predicts_[j]) continue;
    bool seen = true;
    for (std::size_t f = first; f <= last && seen; ++f) seen = clip_.is_observed(f, j);
    if (seen) predictors.push_back(j);
  }
  return predictors;
}

// Sums of products of the columns over the whole frames outside the span.
PoseRegression::Rows PoseRegression::sums_without(FrameSpan span,
                                                  const std::vector<Eigen::Index>& columns,
                                                  std::size_t& count) const {
  const auto begin = std::lower_bound(frames_.begin(), frames_.end(), span.first);
  const auto end = std::upper_bound(begin, frames_.end(), span.last);
  const Eigen::Index at = begin - frames_.begin(), hidden = end - begin;
  count = frames_.size() - static_cast<std::size_t>(hidden);
  Rows sums = sums_(columns, columns);
  if (hidden > 0) {
    const Rows left_out = rows_.middleRows(at, hidden)(Eigen::all, columns);
    sums.noalias() -= left_out.transpose() * left_out;
  }
  return sums;
}

std::vector<Quat> PoseRegression::predict(std::size_t joint, FrameSpan span, std::size_t first,
                                          std::size_t last, double stiffness) const {
  if (!usable_[joint]) return {};
  const std::vector<std::size_t> predictors = predictors_of(joint, first, last);
  if (predictors.size() < least_joints) return {};
  std::vector<Eigen::Index> columns = {0};
  for (const std::size_t j : predictors) {
    for (std::size_t c = 0; c < 3; ++c) columns.push_back(as_index(1 + 3 * j + c));
  }
  for (std::size_t c = 0; c < 3; ++c) columns.push_back(as_index(1 + 3 * joint + c));
  std::size_t count = 0;
  Rows sums = sums_without(span, columns, count);
  const double least = std::max(0.5 * clip_.frame_rate_hz, static_cast<double>(span.length()));
  if (static_cast<double>(count * step_) < least) return {};

  const Eigen::Index inputs = sums.rows() - 3;
  Eigen::MatrixXd system = sums.topLeftCorner(inputs, inputs);
  // The mean is not shrunk, up to what keeps the factors finite.
  system.diagonal().tail(inputs - 1).array() += static_cast<double>(count) * stiffness * stiffness;
  const Eigen::MatrixXd weights = system.llt().solve(sums.topRightCorner(inputs, 3));
  std::vector<Quat> rotations;
  Eigen::RowVectorXd row(inputs);
  row[0] = 1;
  for (std::size_t f = first; f <= last; ++f) {
    for (std::size_t k = 0; k < predictors.size(); ++k) {
      const Vec3 v = vector_of(f, predictors[k]);
      row[as_index(1 + 3 * k)] = v.x, row[as_index(2 + 3 * k)] = v.y,
                           row[as_index(3 + 3 * k)] = v.z;
    }
    const Eigen::RowVector3d y = row * weights;
    rotations.push_back(means_[joint] * exp({y[0], y[1], y[2]}));
  }
  return rotations;
}

}  // namespace kinemend::fill
