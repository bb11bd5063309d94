#include "fill/local_regression.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace kinemend::fill {

namespace {

constexpr std::size_t most_training_frames = 192;
constexpr std::size_t most_shape_frames = 64;
// Observed frames on either side of a gap that tell how a prediction has to be moved.
constexpr std::size_t most_beside = 12;
constexpr double reach_s = 0.5;

// The steadiest companions. They place the group the more, the less their distances vary.
MarkerGroup make_group(std::span<const Companion> companions, std::size_t most) {
  // A distance cannot be known better than to a share of the spread that others have.
  constexpr double least_share = 0.003;
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
  const FrameSpan evidence = evidence_around(samples, gap);
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    if (samples.measures(f, marker_) && !gap.covers(f) && group_.seen_in(samples, f)) {
      training_.push_back(f);
    }
  }
  training_ = evenly(training_, most_training_frames);
  if (usable()) learn();
}

void LocalRegression::learn() {
  group_.fit_shape(samples_, evenly(training_, most_shape_frames));
  rows_.resize(static_cast<Eigen::Index>(training_.size()), inputs() + 4);
  for (std::size_t i = 0; i < training_.size(); ++i) {
    double* row = &rows_(static_cast<Eigen::Index>(i), 0);
    *row++ = 1;
    const Placement placed = put_inputs(training_[i], row);
    const Vec3 own = placed.to_local(samples_.at(training_[i], marker_));
    row += inputs();
    row[0] = own.x, row[1] = own.y, row[2] = own.z;
  }
  sums_.noalias() = rows_.transpose() * rows_;
}

Placement LocalRegression::put_inputs(std::size_t frame, double* row) const {
  const Placement placed = group_.placement(samples_, frame);
  for (std::size_t k = 0; k < group_.markers().size(); ++k) {
    const Vec3 off = placed.to_local(samples_.at(frame, group_.markers()[k])) - group_.shape()[k];
    *row++ = off.x, *row++ = off.y, *row++ = off.z;
  }
  return placed;
}

LocalRegression::Rows LocalRegression::training_inputs() const {
  return rows_.middleCols(1, inputs());
}

LocalRegression::Rows LocalRegression::training_outputs() const { return rows_.rightCols(3); }

// Sums over the training frames outside the span, and how many these are.
LocalRegression::Rows LocalRegression::sums_without(FrameSpan span, double& count) const {
  const auto first = std::lower_bound(training_.begin(), training_.end(), span.first);
  const auto last = std::upper_bound(first, training_.end(), span.last);
  count = static_cast<double>(rows_.rows() - (last - first));
  if (first == last) return sums_;
  const auto hidden = rows_.middleRows(first - training_.begin(), last - first);
  return sums_ - hidden.transpose() * hidden;
}

LocalRegression::Scene LocalRegression::scene_of(const MarkerGap& gap,
                                                 std::span<const std::size_t> wanted) const {
  Scene scene{gap.span, {}, {wanted.begin(), wanted.end()}, {}, {}, {}};
  scene.beside =
      frames_beside(samples_, gap, most_beside, samples_.frames_in(reach_s, most_beside));
  std::erase_if(scene.beside, [&](std::size_t f) { return !group_.seen_in(samples_, f); });
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

std::vector<LocalRegression::Rows> LocalRegression::predict(
    const Scene& scene, std::span<const double> stiffness) const {
  double count = 0;
  const Rows sums = sums_without(scene.span, count);
  const double n = std::max(count, 1.0);
  const Eigen::RowVectorXd mean = sums.row(0) / n;
  const Eigen::MatrixXd centred = sums - n * mean.transpose() * mean;
  const Rows deviations = scene.inputs.rowwise() - mean.segment(1, inputs());
  std::vector<Rows> predictions;
  for (const double stiff : stiffness) {
    Rows outputs = mean.tail(3).replicate(scene.inputs.rows(), 1);
    if (std::isfinite(stiff)) {
      Eigen::MatrixXd system = centred.block(1, 1, inputs(), inputs());
      system.diagonal().array() += n * stiff * stiff;
      outputs.noalias() +=
          deviations * system.ldlt().solve(centred.block(1, inputs() + 1, inputs(), 3));
    }
    predictions.push_back(std::move(outputs));
  }
  return predictions;
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

}  // namespace kinemend::fill
