// The method `pca` for joints: learns a joint's regression from frames in which all are observed.
#include "fill/pose_regression.hpp"

#include <algorithm>
#include <cmath>

#include "fill/methods.hpp"

namespace kinemend::fill {

namespace {

// Not swept. A rotation vector about the mean is smooth up to half a turn. A root's heading is
// independent of the pose; its lean is not.
constexpr double farthest_from_mean = 150 * radians_per_degree;
constexpr double farthest_of_a_root = 45 * radians_per_degree;
constexpr std::size_t most_frames = 1500;             // for speed
constexpr std::size_t least_joints = 4;               // observed beside the gap's own
constexpr double least_learned_s = 0.5;               // of training poses
constexpr double stiffness = 1 * radians_per_degree;  // of the ridge regression

Eigen::Index as_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

PoseRegression::PoseRegression(const Take& clip) : clip_(clip) {
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
    if (whole) training_.frames.push_back(f);
  }
  const std::vector<std::size_t>& whole = training_.frames;
  training_.rows = Rows::Zero(as_index(whole.size()), as_index(1 + 3 * joints));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    double* row = &training_.rows(as_index(i), 0);
    row[0] = 1;
    for (std::size_t j = 0; j < joints; ++j) {
      if (!usable_[j]) continue;
      const Vec3 v = vector_of(whole[i], j);
      row[1 + 3 * j] = v.x, row[2 + 3 * j] = v.y, row[3 + 3 * j] = v.z;
    }
  }
  training_.sums.noalias() = training_.rows.transpose() * training_.rows;
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

std::vector<Quat> PoseRegression::predict(std::size_t joint, FrameSpan span, std::size_t first,
                                          std::size_t last) const {
  if (!usable_[joint]) return {};
  const std::vector<std::size_t> predictors = predictors_of(joint, first, last);
  if (predictors.size() < least_joints) return {};
  std::vector<Eigen::Index> columns = {0};
  const auto append = [&](std::size_t j) {
    for (std::size_t c = 0; c < 3; ++c) columns.push_back(as_index(1 + 3 * j + c));
  };
  for (const std::size_t j : predictors) append(j);
  append(joint);
  const Rows sums = training_.sums_without(span, columns);
  const double least =
      std::max(least_learned_s * clip_.frame_rate_hz, static_cast<double>(span.length()));
  if (sums(0, 0) * static_cast<double>(step_) < least) return {};

  Rows inputs(as_index(last - first + 1), as_index(3 * predictors.size()));
  for (std::size_t f = first; f <= last; ++f) {
    double* row = &inputs(as_index(f - first), 0);
    for (const std::size_t j : predictors) {
      const Vec3 v = vector_of(f, j);
      *row++ = v.x, *row++ = v.y, *row++ = v.z;
    }
  }
  const Rows outputs = ridge_regression(sums, inputs, {&stiffness, 1}).front();
  std::vector<Quat> rotations;
  rotations.reserve(last - first + 1);
  for (const auto& y : outputs.rowwise())
    rotations.push_back(means_[joint] * exp({y[0], y[1], y[2]}));
  return rotations;
}

// The pose's guess needs frames beside the gap, where it is compared with the observed samples.
bool fill_by_poses(Track& track, FrameSpan span, const JointContext& context) {
  const CurveSettings settings = context.curve();
  const auto [first, last] = surroundings(span, {}, velocity_window(settings), track.frames());
  const std::size_t shift = track.first_frame;
  const std::vector<Quat> rotations = context.poses.predict(
      track.joint, {span.first + shift, span.last + shift}, first + shift, last + shift);
  if (rotations.empty()) return false;
  Guess guess{first, {}};
  for (std::size_t f = first; f <= last; ++f)
    guess.values.push_back(track.chart.vector_of(f, rotations[f - first]));
  place_guess(track, span, guess, settings);
  return true;
}

}  // namespace kinemend::fill
