// The methods that fill a marker's gap from other markers: their movement, a rigid body, a local
// regression, and principal components.
#include "fill/methods.hpp"

#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable.hpp"
#include "fill/regression.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend::fill {

namespace {

// The part of the donor's movement beside the gap that is used. Not swept.
constexpr double pattern_beside_s = 0.3;
constexpr std::size_t least_beside = 16;  // frames

}  // namespace

Filling fill_by_pattern(const Samples& samples, const MarkerGap& gap, const GapRequest& request) {
  constexpr std::string_view name = "pattern";
  const std::size_t donor = request.donor;
  if (donor == gap.marker) return Filling::refused(name, "the marker is its own donor");
  // Finds the donor's contiguous frames that cover the gap and enough frames beside it to meet the
  // ends.
  const std::size_t reach = samples.frames_in(pattern_beside_s, least_beside);
  std::size_t first = gap.span.first, last = gap.span.last;
  for (std::size_t f = first; f <= last; ++f) {
    if (samples.sees(f, donor)) continue;
    return Filling::refused(name,
                            fmt::format("the donor is missing in frame {}",
                                        static_cast<std::int64_t>(f) + samples.first_frame),
                            true);
  }
  while (first > 0 && gap.span.first - first < reach && samples.sees(first - 1, donor)) --first;
  while (last + 1 < samples.frames && last - gap.span.last < reach &&
         samples.sees(last + 1, donor)) {
    ++last;
  }
  const auto meets = [&](bool at_end, std::size_t beside) {
    return !at_end && samples.sees(beside, donor) && samples.measures(beside, gap.marker);
  };
  const bool before = meets(gap.span.first == 0, gap.span.first - 1);
  const bool behind = meets(gap.span.last + 1 == samples.frames, gap.span.last + 1);
  if (!(before && behind) && !(request.fill_all && (before || behind))) {
    return Filling::refused(name, "the donor and the marker are not both seen at the gap's ends");
  }
  Track track = track_around(samples, gap);
  const FrameSpan span = within(track, gap.span);
  Guess guess{first - track.first_frame, {}};
  for (std::size_t f = first; f <= last; ++f) guess.values.push_back(samples.at(f, donor));
  place_guess(track, span, guess, {.frame_rate_hz = samples.frame_rate_hz});
  Filling filling{values_in(track, span), std::string(name)};
  filling.markers_used = {donor};
  return filling;
}

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

Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap, const GapRequest&) {
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
                           const GapRequest& request) {
  constexpr std::string_view name = "rigid-body";
  constexpr double rigid = std::numeric_limits<double>::infinity();
  const double limit = segment_spread * samples.radius;
  std::vector<Companion> segment = companions_of(samples, gap, helpers_of(samples, gap));
  const auto strangers = std::find_if(segment.begin(), segment.end(),
                                      [&](const Companion& c) { return c.spread > limit; });
  const std::size_t count = static_cast<std::size_t>(strangers - segment.begin());
  segment.resize(
      std::min(segment.size(), request.fill_all ? std::max(count, least_companions) : count));
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

namespace {

// Not swept; the value of Gloersen & Federolf 2016: the width of the weights by distance, 200 mm on
// a body with a radius of 450 mm.
constexpr double weight_radius = 0.45;
constexpr double least_weight = 0.02;          // of a helper at any distance
constexpr std::size_t least_frames = 30;       // frames in which all helpers are seen
constexpr std::size_t most_pca_frames = 1024;  // for speed
// Components are kept until they hold this share of the weighted variance.
constexpr double kept_variance = 0.9999;

Vec3 centre_of(const Samples& samples, std::size_t frame, const std::vector<std::size_t>& helpers) {
  Vec3 centre;
  for (const std::size_t m : helpers) centre += samples.at(frame, m);
  return (1 / static_cast<double>(helpers.size())) * centre;
}

// Regression of the marker on the principal components of the body-centred helpers.
class ComponentRegression {
 public:
  ComponentRegression(const Samples& samples, std::size_t marker,
                      const std::vector<std::size_t>& helpers,
                      const std::vector<std::size_t>& frames, double radius)
      : samples_(samples), helpers_(helpers), weights_(helpers.size(), 0.0) {
    Rows x(frames.size(), 3 * helpers.size()), y(frames.size(), 3);
    for (const std::size_t frame : frames) {
      const Vec3 own = samples.at(frame, marker);
      for (std::size_t k = 0; k < helpers.size(); ++k) {
        weights_[k] += norm(samples.at(frame, helpers[k]) - own);
      }
    }
    for (double& weight : weights_) {
      const double u = weight / static_cast<double>(frames.size()) / (weight_radius * radius);
      weight = std::max(least_weight, portable::exp(-u * u / 2));
    }
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Vec3 centre = put_row(frames[i], &x(row, 0));
      const Vec3 own = samples.at(frames[i], marker) - centre;
      y.row(row) << own.x, own.y, own.z;
    }
    mean_x_ = x.colwise().mean();
    mean_y_ = y.colwise().mean();
    x.rowwise() -= mean_x_;
    y.rowwise() -= mean_y_;
    const auto [variances, directions] = symmetric_eigen(x.transpose() * x);
    const double total = variances.sum();
    Eigen::Index kept = 0;
    for (double held = 0; kept < variances.size() && held < kept_variance * total; ++kept) {
      held += variances[variances.size() - 1 - kept];
    }
    const Eigen::MatrixXd vectors = directions.rightCols(kept);
    coefficients_ = vectors * variances.tail(kept).cwiseMax(1e-300).cwiseInverse().asDiagonal() *
                    (vectors.transpose() * (x.transpose() * y));
  }

  Vec3 operator()(std::size_t frame) const {
    Eigen::RowVectorXd x(coefficients_.rows());
    const Vec3 centre = put_row(frame, x.data());
    const Eigen::RowVector3d y = mean_y_ + (x - mean_x_) * coefficients_;
    return centre + Vec3{y[0], y[1], y[2]};
  }

 private:
  Vec3 put_row(std::size_t frame, double* row) const {
    const Vec3 centre = centre_of(samples_, frame, helpers_);
    for (std::size_t k = 0; k < helpers_.size(); ++k) {
      const Vec3 off = weights_[k] * (samples_.at(frame, helpers_[k]) - centre);
      *row++ = off.x, *row++ = off.y, *row++ = off.z;
    }
    return centre;
  }

  const Samples& samples_;
  const std::vector<std::size_t>& helpers_;
  std::vector<double> weights_;
  Eigen::RowVectorXd mean_x_;
  Eigen::RowVector3d mean_y_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace

Filling fill_by_pca(const Samples& samples, const MarkerGap& gap, const GapRequest&) {
  constexpr std::string_view name = "pca";
  const std::vector<std::size_t> helpers = helpers_of(samples, gap);
  const std::vector<std::size_t> frames =
      evenly(frames_showing(samples, gap, helpers), most_pca_frames);
  if (helpers.size() < least_companions || frames.size() < least_frames) {
    return Filling::refused(
        name,
        helpers.size() < least_companions
            ? "fewer than three other markers are seen throughout the gap"
            : "fewer than 30 frames show the marker together with those seen in the gap",
        true);
  }
  const ComponentRegression regression(samples, gap.marker, helpers, frames, samples.radius);
  const std::vector<std::size_t> beside = frames_beside(samples, gap, helpers);
  const std::vector<std::size_t> wanted = frames_of(gap.span);
  std::vector<Vec3> errors, positions;
  for (const std::size_t f : beside) errors.push_back(samples.at(f, gap.marker) - regression(f));
  for (const std::size_t f : wanted) positions.push_back(regression(f));
  const std::vector<Vec3> moves =
      Bridge(beside, gap.span, wanted, samples.frame_rate_hz, {}).carry(errors);
  for (std::size_t i = 0; i < wanted.size(); ++i) positions[i] += moves[i];
  Filling filling{std::move(positions), std::string(name)};
  filling.markers_used = helpers;
  return filling;
}

}  // namespace kinemend::fill
