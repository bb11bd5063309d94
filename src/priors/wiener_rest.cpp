#include "priors/wiener_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int largest_octave = 5;        // scales are 2^-5 to 2^5
constexpr double octave_penalty = 0.02;  // log prior of a scale: - penalty octave^2
constexpr double prior_windows = 8;
constexpr double least_variance = 1e-9;  // square degrees
constexpr std::size_t scale_count = 2 * largest_octave + 1;

// Coefficients about k that are taken to have one variance.
struct Band {
  Index first, last;
};
Band band_about(Index k, Index count) {
  const auto about = static_cast<double>(k);
  const Index first = std::min(k - 1, static_cast<Index>(about * 0.85));
  const Index last = std::max(k + 1, static_cast<Index>(about * 1.2));
  return {std::max<Index>(first, 0), std::min(last, count - 1)};
}

}  // namespace

RestModel::RestModel(const MatrixXd& prior, const VectorXd& noise, Index frames)
    : prior_(frames, prior.rows()),
      noise_(noise),
      squares_(MatrixXd::Zero(frames, prior.rows())),
      counts_(VectorXd::Zero(prior.rows())) {
  // Above the frequencies of the model, where takes have a higher rate, spectra fall on.
  for (Index k = 0; k < frames; ++k) {
    const Index known = std::min(k, prior.cols() - 1);
    const double fall = std::pow(static_cast<double>(known + 1) / static_cast<double>(k + 1), 4);
    prior_.row(k) = fall * prior.col(known).transpose();
  }
}

void RestModel::add(const MatrixXd& left, const VectorXd& counts) {
  squares_ += left.cwiseAbs2() * counts.asDiagonal();
  counts_ += counts;
}

void RestModel::add(const RestModel& other) {
  squares_ += other.squares_;
  counts_ += other.counts_;
}

void RestModel::learn(double window_weight) {
  const Index frames = prior_.rows(), channels = prior_.cols();
  MatrixXd variance(frames, channels);
  for (Index d = 0; d < channels; ++d) {
    const VectorXd signal = (squares_.col(d) / std::max(counts_(d), 1.0)).array() - noise_(d);
    const double windows = counts_(d) * window_weight;
    for (Index k = 0; k < frames; ++k) {
      const Band band = band_about(k, frames);
      const double mean = signal.segment(band.first, band.last - band.first + 1).mean();
      variance(k, d) = (windows * std::max(mean, 0.0) + prior_windows * prior_(k, d)) /
                           (windows + prior_windows) +
                       least_variance;
    }
  }
  scales_.clear();
  for (int octave = -largest_octave; octave <= largest_octave; ++octave) {
    const MatrixXd scaled = std::ldexp(1.0, octave) * variance;
    const MatrixXd total = scaled.rowwise() + noise_.transpose();
    scales_.push_back({-octave_penalty * octave * octave, scaled.cwiseQuotient(total),
                       total.cwiseInverse(),
                       -0.5 * total.array().log().colwise().sum().matrix().transpose()});
  }
}

void RestModel::shrink(MatrixXd& left) const {
  const Index frames = prior_.rows();
  for (Index first = 0; first < left.cols(); first += 3) {
    const Index width = std::min<Index>(3, left.cols() - first);
    const MatrixXd squares = left.middleCols(first, width).cwiseAbs2();
    std::array<double, scale_count> share{};
    double best = -1e300;
    for (std::size_t s = 0; s < scale_count; ++s) {
      const Scale& scale = scales_[s];
      share[s] = scale.log_prior + scale.log_density.segment(first, width).sum() -
                 0.5 * squares.cwiseProduct(scale.precision.middleCols(first, width)).sum();
      best = std::max(best, share[s]);
    }
    double sum = 0;
    for (double& value : share) sum += value = std::exp(value - best);
    MatrixXd gain = MatrixXd::Zero(frames, width);
    for (std::size_t s = 0; s < scale_count; ++s) {
      if (share[s] > 1e-6 * sum) gain += share[s] / sum * scales_[s].gain.middleCols(first, width);
    }
    left.middleCols(first, width).array() *= gain.array();
  }
}

}  // namespace kinemend
