#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fill/bridge.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t least_helpers = 3;
constexpr std::size_t least_frames = 30;
constexpr std::size_t most_frames = 1024;
// Width of the weights by distance: 200 mm on a body whose radius is 450 mm.
constexpr double weight_radius = 0.45;
constexpr double least_weight = 0.02;
// Components are kept until they hold this share of the weighted variance.
constexpr double kept_variance = 0.9999;

// Frames that the marker and all helpers are seen in, without the gap.
std::vector<std::size_t> complete_frames(const Samples& samples, const MarkerGap& gap,
                                         const std::vector<std::size_t>& helpers) {
  std::vector<std::size_t> frames;
  const FrameSpan evidence = evidence_around(samples, gap);
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    if (std::all_of(helpers.begin(), helpers.end(),
                    [&](std::size_t m) { return samples.sees(f, m); })) {
      frames.push_back(f);
    }
  }
  return frames;
}

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
      weight = std::max(least_weight, std::exp(-u * u / 2));
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
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(x.transpose() * x);
    const Eigen::VectorXd& variances = solver.eigenvalues();  // ascending
    const double total = variances.sum();
    Eigen::Index kept = 0;
    for (double held = 0; kept < variances.size() && held < kept_variance * total; ++kept) {
      held += variances[variances.size() - 1 - kept];
    }
    const Eigen::MatrixXd vectors = solver.eigenvectors().rightCols(kept);
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
      evenly(complete_frames(samples, gap, helpers), most_frames);
  if (helpers.size() < least_helpers || frames.size() < least_frames) {
    Filling refused = Filling::refused(
        name, helpers.size() < least_helpers
                  ? "fewer than three other markers are seen throughout the gap"
                  : "fewer than 30 frames show the marker together with those seen in the gap");
    refused.may_wait = true;
    return refused;
  }
  const ComponentRegression regression(samples, gap.marker, helpers, frames, samples.radius);
  std::vector<std::size_t> beside = frames_beside(samples, gap, 12, samples.frames_in(0.5, 12));
  std::erase_if(beside, [&](std::size_t f) {
    return !std::all_of(helpers.begin(), helpers.end(),
                        [&](std::size_t m) { return samples.sees(f, m); });
  });
  std::vector<std::size_t> wanted(gap.span.length());
  std::iota(wanted.begin(), wanted.end(), gap.span.first);
  std::vector<Vec3> errors, positions;
  for (const std::size_t f : beside) {
    errors.push_back(samples.at(f, gap.marker) - regression(f));
  }
  for (const std::size_t f : wanted) positions.push_back(regression(f));
  const Bridge bridge(beside, gap.span, wanted, samples.frame_rate_hz, {});
  const std::vector<Vec3> moves = bridge.carry(errors);
  for (std::size_t i = 0; i < wanted.size(); ++i) positions[i] += moves[i];
  return {std::move(positions), std::string(name)};
}

}  // namespace kinemend::fill
