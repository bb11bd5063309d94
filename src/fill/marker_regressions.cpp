// The methods that predict a marker from its companions: a rigid body and a local regression.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable.hpp"
#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

// The stiffnesses are those of `auto`; the values below are not swept.
constexpr std::size_t most_companions = 8;
// The width of the neighbours' weights, as a share of the inputs' spread.
constexpr double width_share = 0.3;
// The least spread of a distance, as a share of the body's radius, so that a nearly constant
// distance does not decide alone.
constexpr double least_spread_share = 0.002;
constexpr int distance_rounds = 4;  // passes over the companions

// The statistics of the distance from the marker to one companion.
struct Distance {
  double mean = 0, spread = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0;
};

Eigen::RowVector3d companion_at(const LocalRegression& body, const Rows& inputs, Eigen::Index row,
                                std::size_t k) {
  const Vec3 shape = body.group().shape()[k];
  return Eigen::RowVector3d(shape.x, shape.y, shape.z) +
         inputs.block<1, 3>(row, static_cast<Eigen::Index>(3 * k));
}

std::vector<Distance> distances_of(const LocalRegression& body) {
  const Rows inputs = body.training_inputs(), outputs = body.training_outputs();
  std::vector<Distance> distances(body.group().markers().size());
  for (std::size_t k = 0; k < distances.size(); ++k) {
    Distance& d = distances[k];
    double squares = 0;
    for (Eigen::Index row = 0; row < inputs.rows(); ++row) {
      const double length = (outputs.row(row) - companion_at(body, inputs, row, k)).norm();
      const double step = length - d.mean;
      d.mean += step / static_cast<double>(row + 1);
      squares += step * (length - d.mean);
      d.least = std::min(d.least, length);
      d.most = std::max(d.most, length);
    }
    d.spread = std::sqrt(squares / static_cast<double>(inputs.rows()));
  }
  return distances;
}

// Regresses on the neighbours in the space of the inputs (a general regression neural network,
// Specht 1991).
Rows by_neighbours(const LocalRegression& body, const LocalRegression::Scene& scene) {
  const Rows inputs = body.training_inputs(), outputs = body.training_outputs();
  const double variance =
      (inputs.rowwise() - inputs.colwise().mean()).rowwise().squaredNorm().mean();
  const double scale =
      -1 / (2 * width_share * width_share * variance + std::numeric_limits<double>::min());
  Rows result(scene.inputs.rows(), 3);
  for (Eigen::Index row = 0; row < result.rows(); ++row) {
    Eigen::VectorXd squares = (inputs.rowwise() - scene.inputs.row(row)).rowwise().squaredNorm();
    const double nearest = squares.minCoeff();
    const Eigen::VectorXd weights =
        ((squares.array() - nearest) * scale).unaryExpr([](double x) { return portable::exp(x); });
    result.row(row) = weights.transpose() * outputs / weights.sum();
  }
  return result;
}

// Returns the likelihood of a position's distances to the companions, from their mean squared
// z-scores.
double likelihood(const LocalRegression& body, const LocalRegression::Scene& scene,
                  Eigen::Index row, const Eigen::RowVector3d& position,
                  const std::vector<Distance>& distances, double least_spread) {
  double sum = 0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double length = (position - companion_at(body, scene.inputs, row, k)).norm();
    const double z = (length - distances[k].mean) / (distances[k].spread + least_spread);
    sum += z * z;
  }
  return portable::exp(-sum / (2 * static_cast<double>(distances.size())));
}

// Moves a position until its distances to the companions lie within the range seen in the take.
void hold_distances(const LocalRegression& body, const LocalRegression::Scene& scene,
                    Eigen::Index row, const std::vector<Distance>& distances, Rows& coordinates) {
  for (int round = 0; round < distance_rounds; ++round) {
    for (std::size_t k = 0; k < distances.size(); ++k) {
      const Eigen::RowVector3d off =
          coordinates.row(row) - companion_at(body, scene.inputs, row, k);
      const double length = off.norm();
      const double wanted = std::clamp(length, distances[k].least, distances[k].most);
      if (length > 0 && wanted != length) coordinates.row(row) += (wanted / length - 1) * off;
    }
  }
}

Rows averaged(const LocalRegression& body, const LocalRegression::Scene& scene, double radius) {
  std::vector<Rows> models = body.predict(scene, stiffnesses_of(radius));
  models.push_back(by_neighbours(body, scene));
  const std::vector<Distance> distances = distances_of(body);
  const double least_spread = least_spread_share * radius + std::numeric_limits<double>::min();
  Rows result = Rows::Zero(scene.inputs.rows(), 3);
  for (Eigen::Index row = 0; row < result.rows(); ++row) {
    double total = 0;
    for (const Rows& model : models) {
      const double weight = likelihood(body, scene, row, model.row(row), distances, least_spread) +
                            std::numeric_limits<double>::min();
      result.row(row) += weight * model.row(row);
      total += weight;
    }
    result.row(row) /= total;
    hold_distances(body, scene, row, distances, result);
  }
  return result;
}

Filling filling_of(const LocalRegression& body, std::vector<Vec3> values, std::string_view name) {
  Filling filling{std::move(values), std::string(name)};
  const auto markers = body.group().markers();
  filling.markers_used = {markers.begin(), markers.end()};
  return filling;
}

}  // namespace

Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap,
                                 const MarkerRequest&) {
  constexpr std::string_view name = "local-regression";
  const std::vector<Companion> companions = companions_of(samples, gap, helpers_of(samples, gap));
  const LocalRegression body(samples, gap, companions, most_companions);
  if (companions.size() < least_companions || !body.usable()) {
    return Filling::refused(
        name,
        companions.size() < least_companions
            ? "fewer than three other markers are seen throughout the gap"
            : "fewer than 8 frames show the marker together with its companions",
        true);
  }
  const LocalRegression::Scene scene = body.scene_of(gap, frames_of(gap.span));
  const Rows coordinates = averaged(body, scene, samples.radius);
  return filling_of(body, LocalRegression::meet_ends(scene, body.bridge_of(scene), coordinates),
                    name);
}

Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap,
                           const MarkerRequest& request) {
  constexpr std::string_view name = "rigid-body";
  constexpr double rigid = std::numeric_limits<double>::infinity();
  const double limit = segment_spread * samples.radius;
  std::vector<Companion> segment = companions_of(samples, gap, helpers_of(samples, gap));
  const auto strangers = std::find_if(segment.begin(), segment.end(),
                                      [&](const Companion& c) { return c.spread > limit; });
  const std::size_t count = static_cast<std::size_t>(strangers - segment.begin());
  segment.resize(
      std::min(segment.size(), request.lenient ? std::max(count, least_companions) : count));
  const LocalRegression body(samples, gap, segment, most_companions);
  if (segment.size() < least_companions || !body.usable() || !body.group().turns()) {
    return Filling::refused(
        name,
        fmt::format("{} other markers of its segment are seen throughout the gap; three that "
                    "are not on one line are needed",
                    count),
        true);
  }
  const LocalRegression::Scene scene = body.scene_of(gap, frames_of(gap.span));
  const Rows still = body.predict(scene, {&rigid, 1}).front();
  return filling_of(body, LocalRegression::meet_ends(scene, body.bridge_of(scene), still), name);
}

}  // namespace kinemend::fill
