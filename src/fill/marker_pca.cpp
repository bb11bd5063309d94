// The method `pca` for markers: a regression on the principal components of the other markers.
#include <Eigen/Core>
#include <algorithm>

#include "base/portable.hpp"
#include "fill/bridge.hpp"
#include "fill/marker_methods.hpp"
#include "fill/ridge.hpp"
#include "signal/symmetric_eigen.hpp"

namespace kinemend::fill {

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

Filling fill_by_pca(const Samples& samples, const MarkerGap& gap, const MarkerRequest&) {
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
