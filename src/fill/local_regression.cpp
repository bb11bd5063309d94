// Learns the regression from frames outside the gap and predicts the frames in it.
#include "fill/local_regression.hpp"

#include <algorithm>

namespace kinemend::fill {

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

}  // namespace kinemend::fill
