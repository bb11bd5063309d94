// Solves the ridge regression, learns the predictions of a marker and of a joint, and carries the
// errors beside a gap into it.
#include "fill/regression.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "fill/methods.hpp"

namespace kinemend::fill {

std::vector<Rows> ridge_regression(const Rows& sums, const Rows& inputs,
                                   std::span<const double> stiffness) {
  const Eigen::Index width = inputs.cols();
  const double n = std::max(sums(0, 0), 1.0);
  const Eigen::RowVectorXd mean = sums.row(0) / n;
  const Eigen::MatrixXd centred = sums - n * mean.transpose() * mean;
  const Rows deviations = inputs.rowwise() - mean.segment(1, width);
  std::vector<Rows> predictions;
  for (const double stiff : stiffness) {
    Rows outputs = mean.tail(3).replicate(inputs.rows(), 1);
    if (std::isfinite(stiff)) {
      Eigen::MatrixXd system = centred.block(1, 1, width, width);
      system.diagonal().array() += n * stiff * stiff;
      outputs.noalias() += deviations * system.ldlt().solve(centred.block(1, width + 1, width, 3));
    }
    predictions.push_back(std::move(outputs));
  }
  return predictions;
}

namespace {

constexpr std::size_t most_training_frames = 192, most_shape_frames = 64;  // for speed
// A floor of a distance's spread, as a share of the other companions' spread. Not swept.
constexpr double least_share = 0.003;

// Takes the steadiest companions. Their weight grows as the variation of their distance shrinks.
MarkerGroup make_group(std::span<const Companion> companions, std::size_t most) {
  const std::size_t count = std::min(most, companions.size());
  if (count == 0) return {{}, {}};
  const double floor = least_share * companions[count - 1].spread;
  const double scale = companions[0].spread + floor;
  std::vector<std::size_t> markers;
  std::vector<double> weights;
  for (std::size_t k = 0; k < count; ++k) {
    const double spread = companions[k].spread + floor;
    const double share = spread > 0 ? scale / spread : 1;
    markers.push_back(companions[k].marker);
    weights.push_back(share * share * share);
  }
  return {std::move(markers), std::move(weights)};
}

}  // namespace

LocalRegression::LocalRegression(const Samples& samples, const MarkerGap& gap,
                                 std::span<const Companion> companions, std::size_t most_companions)
    : samples_(samples), marker_(gap.marker), group_(make_group(companions, most_companions)) {
  if (group_.markers().empty()) return;
  training_.frames = evenly(frames_showing(samples, gap, group_.markers()), most_training_frames);
  if (usable()) learn();
}

void LocalRegression::learn() {
  const std::vector<std::size_t>& frames = training_.frames;
  group_.fit_shape(samples_, evenly(frames, most_shape_frames));
  training_.rows.resize(static_cast<Eigen::Index>(frames.size()), inputs() + 4);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double* row = &training_.rows(static_cast<Eigen::Index>(i), 0);
    *row++ = 1;
    const Placement placed = put_inputs(frames[i], row);
    const Vec3 own = placed.to_local(samples_.at(frames[i], marker_));
    row += inputs();
    row[0] = own.x, row[1] = own.y, row[2] = own.z;
  }
  training_.sums.noalias() = training_.rows.transpose() * training_.rows;
}

Placement LocalRegression::put_inputs(std::size_t frame, double* row) const {
  const Placement placed = group_.placement(samples_, frame);
  for (std::size_t k = 0; k < group_.markers().size(); ++k) {
    const Vec3 off = placed.to_local(samples_.at(frame, group_.markers()[k])) - group_.shape()[k];
    *row++ = off.x, *row++ = off.y, *row++ = off.z;
  }
  return placed;
}

Rows LocalRegression::training_inputs() const { return training_.rows.middleCols(1, inputs()); }

Rows LocalRegression::training_outputs() const { return training_.rows.rightCols(3); }

LocalRegression::Scene LocalRegression::scene_of(const MarkerGap& gap,
                                                 std::span<const std::size_t> wanted) const {
  Scene scene{gap.span,
              frames_beside(samples_, gap, group_.markers()),
              {wanted.begin(), wanted.end()},
              {},
              {},
              {}};
  std::vector<std::size_t> frames = scene.beside;
  frames.insert(frames.end(), wanted.begin(), wanted.end());
  scene.inputs.resize(static_cast<Eigen::Index>(frames.size()), inputs());
  scene.seen.resize(static_cast<Eigen::Index>(scene.beside.size()), 3);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    scene.placed.push_back(put_inputs(frames[i], &scene.inputs(row, 0)));
    if (i >= scene.beside.size()) continue;
    const Vec3 own = scene.placed[i].to_local(samples_.at(frames[i], marker_));
    scene.seen.row(row) << own.x, own.y, own.z;
  }
  return scene;
}

std::vector<Rows> LocalRegression::predict(const Scene& scene,
                                           std::span<const double> stiffness) const {
  return ridge_regression(training_.sums_without(scene.span, Eigen::all), scene.inputs, stiffness);
}

Bridge LocalRegression::bridge_of(const Scene& scene, const Bridge::Settings& settings) const {
  return {scene.beside, scene.span, scene.wanted, samples_.frame_rate_hz, settings};
}

std::vector<Vec3> LocalRegression::meet_ends(const Scene& scene, const Bridge& bridge,
                                             const Rows& coordinates) {
  const auto vector_of = [](const Rows& rows, std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    return Vec3{rows(row, 0), rows(row, 1), rows(row, 2)};
  };
  std::vector<Vec3> errors;
  for (std::size_t i = 0; i < scene.beside.size(); ++i) {
    errors.push_back(vector_of(scene.seen, i) - vector_of(coordinates, i));
  }
  const std::vector<Vec3> moves = bridge.carry(errors);
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < scene.wanted.size(); ++i) {
    const std::size_t row = scene.beside.size() + i;
    positions.push_back(scene.placed[row].to_world(vector_of(coordinates, row) + moves[i]));
  }
  return positions;
}

namespace {

// These and the memories were chosen on the takes that docs/measured/fill.md names.
// The slow part's share of the errors' variance, and its memory relative to the fast part's.
constexpr double slow_share = 0.4;
constexpr double slow_memory = 6;
// The noise variance of a sample next to the gap, as a share of the errors' variance.
constexpr double end_noise = 1e-5;

double covariance(double lag, double memory) {
  const double u = std::sqrt(5.0) * lag / memory;
  const double v = std::sqrt(3.0) * lag / (slow_memory * memory);
  return (1 - slow_share) * (1 + u + u * u / 3) * portable::exp(-u) +
         slow_share * (1 + v) * portable::exp(-v);
}

// `by_lag[k]` is the covariance of errors k frames apart.
Eigen::MatrixXd covariances(std::span<const std::size_t> rows, std::span<const std::size_t> columns,
                            const std::vector<double>& by_lag) {
  Eigen::MatrixXd matrix(rows.size(), columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::size_t lag = rows[r] > columns[c] ? rows[r] - columns[c] : columns[c] - rows[r];
      matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = by_lag[lag];
    }
  }
  return matrix;
}

}  // namespace

Bridge::Bridge(std::span<const std::size_t> beside, FrameSpan span,
               std::span<const std::size_t> wanted, double frame_rate_hz, const Settings& settings)
    : wanted_(wanted.size()), beside_(beside.size()), weights_(beside.size() * wanted.size()) {
  if (weights_.empty()) return;
  const double memory = settings.memory_s * frame_rate_hz;
  const std::size_t first = std::min(beside.front(), span.first);
  std::vector<double> by_lag(std::max(beside.back(), span.last) - first + 1);
  for (std::size_t lag = 0; lag < by_lag.size(); ++lag) {
    by_lag[lag] = covariance(static_cast<double>(lag), memory);
  }
  Eigen::MatrixXd system = covariances(beside, beside, by_lag);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const bool is_end = beside[i] + 1 == span.first || beside[i] == span.last + 1;
    system.diagonal()[static_cast<Eigen::Index>(i)] += is_end ? end_noise : settings.noise;
  }
  // Column-major beside x wanted is row-major wanted x beside.
  Eigen::Map<Eigen::MatrixXd>(weights_.data(), static_cast<Eigen::Index>(beside.size()),
                              static_cast<Eigen::Index>(wanted.size())) =
      system.llt().solve(covariances(beside, wanted, by_lag));
}

std::vector<Vec3> Bridge::carry(std::span<const Vec3> errors) const {
  std::vector<Vec3> carried(wanted_);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    for (std::size_t k = 0; k < beside_; ++k) {
      carried[i] += weights_[i * beside_ + k] * errors[k];
    }
  }
  return carried;
}

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
