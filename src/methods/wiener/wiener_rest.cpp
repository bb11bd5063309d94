// Learns the spectrum of the rest and shrinks coefficients by their evidence at each scale.
#include "methods/wiener/wiener_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/portable.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int largest_octave = 5;        // scales are 2^-5 to 2^5
constexpr double octave_penalty = 0.02;  // log prior of a scale: - penalty octave^2
// The noise of a window, relative to that of the take, is a power of two between these.
constexpr int least_noise_octave = -1;
constexpr int largest_noise_octave = 6;
constexpr double noise_coefficients = 20;  // weight of the take's noise in a window
constexpr double motionless_hz = 35;       // motion above it is negligible
// The weight of the model's own rest, in windows of the take (ablation_wiener.csv, "the take worth
// little").
constexpr double prior_windows = 8;
constexpr double least_rest_variance = 1e-9;  // square degrees
constexpr std::size_t scale_count = 2 * largest_octave + 1;
constexpr std::size_t noise_count = largest_noise_octave - least_noise_octave + 1;

// Coefficients about k over which variances are averaged.
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

RestModel::RestModel(const MatrixXd& prior, const VectorXd& noise, Index frames, double window_s)
    : prior_(frames, prior.rows()),
      noise_(noise),
      motionless_(std::min(frames, static_cast<Index>(std::ceil(2 * window_s * motionless_hz)))),
      signal_(MatrixXd::Zero(frames, prior.rows())),
      counts_(VectorXd::Zero(prior.rows())) {
  // Above the model's frequencies, at higher rates, the spectrum is extrapolated.
  for (Index k = 0; k < frames; ++k) {
    const Index known = std::min(k, prior.cols() - 1);
    const double fall =
        portable::pow(static_cast<double>(known + 1) / static_cast<double>(k + 1), 4);
    prior_.row(k) = fall * prior.col(known).transpose();
  }
}

// Noise of a channel in a window, from its highest frequencies.
int RestModel::noise_octave(const MatrixXd& left, Index channel) const {
  const Index count = left.rows() - motionless_;
  if (count <= 0) return 0;
  const double seen = left.col(channel).tail(count).squaredNorm();
  const double factor = (seen / noise_(channel) + noise_coefficients) /
                        (static_cast<double>(count) + noise_coefficients);
  return std::clamp(static_cast<int>(std::lround(portable::log2(factor))), least_noise_octave,
                    largest_noise_octave);
}

void RestModel::add(const MatrixXd& left, const VectorXd& counts) {
  for (Index d = 0; d < left.cols(); ++d) {
    if (counts(d) == 0) continue;
    signal_.col(d).array() +=
        left.col(d).array().square() - std::ldexp(noise_(d), noise_octave(left, d));
  }
  counts_ += counts;
}

void RestModel::add(const RestModel& other) {
  signal_ += other.signal_;
  counts_ += other.counts_;
}

void RestModel::learn(double window_weight) {
  const Index frames = prior_.rows(), channels = prior_.cols();
  MatrixXd variance(frames, channels);
  for (Index d = 0; d < channels; ++d) {
    const VectorXd signal = signal_.col(d) / std::max(counts_(d), 1.0);
    const double windows = counts_(d) * window_weight;
    for (Index k = 0; k < frames; ++k) {
      const Band band = band_about(k, frames);
      const double mean = signal.segment(band.first, band.last - band.first + 1).mean();
      variance(k, d) = (windows * std::max(mean, 0.0) + prior_windows * prior_(k, d)) /
                           (windows + prior_windows) +
                       least_rest_variance;
    }
  }
  scales_.clear();
  for (int octave = -largest_octave; octave <= largest_octave; ++octave) {
    const MatrixXd scaled = std::ldexp(1.0, octave) * variance;
    for (int noise = least_noise_octave; noise <= largest_noise_octave; ++noise) {
      const MatrixXd total = scaled.rowwise() + std::ldexp(1.0, noise) * noise_.transpose();
      scales_.push_back({scaled.cwiseQuotient(total), total.cwiseInverse(),
                         -0.5 * total.array()
                                    .unaryExpr([](double x) { return portable::log(x); })
                                    .colwise()
                                    .sum()
                                    .matrix()
                                    .transpose()});
    }
  }
}

void RestModel::shrink(MatrixXd& left) const {
  for (Index first = 0; first < left.cols(); first += 3) {
    const Index last = std::min<Index>(first + 3, left.cols());
    std::array<std::size_t, 3> noise{};
    for (Index d = first; d < last; ++d) {
      noise[static_cast<std::size_t>(d - first)] =
          static_cast<std::size_t>(noise_octave(left, d) - least_noise_octave);
    }
    const auto scale_at = [&](std::size_t s, Index d) -> const Scale& {
      return scales_[s * noise_count + noise[static_cast<std::size_t>(d - first)]];
    };
    std::array<double, scale_count> share{};
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < scale_count; ++s) {
      const double octave = static_cast<double>(s) - largest_octave;
      share[s] = -octave_penalty * octave * octave;
      for (Index d = first; d < last; ++d) {
        const Scale& scale = scale_at(s, d);
        share[s] +=
            scale.log_density(d) - 0.5 * left.col(d).cwiseAbs2().dot(scale.precision.col(d));
      }
      best = std::max(best, share[s]);
    }
    double sum = 0;
    for (double& value : share) sum += value = portable::exp(value - best);
    for (Index d = first; d < last; ++d) {
      VectorXd gain = VectorXd::Zero(left.rows());
      for (std::size_t s = 0; s < scale_count; ++s) {
        if (share[s] > 1e-6 * sum) gain += share[s] / sum * scale_at(s, d).gain.col(d);
      }
      left.col(d).array() *= gain.array();
    }
  }
}

}  // namespace kinemend
