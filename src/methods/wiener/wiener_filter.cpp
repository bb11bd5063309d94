// Computes the posterior mean of a take under the prior of `wiener`, window by window, and models
// what a take does outside of the learned patterns.
#include "methods/wiener/wiener_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "methods/prior/window_bases.hpp"
#include "nn/gemm.hpp"

namespace kinemend {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// If more than one in this number of samples is missing, a channel is conditioned on the others.
// Chosen by hand (docs/details/wiener.md, step 4), not swept.
constexpr Index guessed_share = 8;

}  // namespace

WienerWindows::WienerWindows(const WienerPrior& prior, Index window_frames, Index frames,
                             std::span<const std::uint8_t> observed, std::span<const double> noise)
    : prior_(prior),
      frames_(window_frames),
      take_frames_(frames),
      noise_(Eigen::Map<const VectorXd>(noise.data(), static_cast<Index>(noise.size()))
                 .array()
                 .square() /
             static_cast<double>(window_frames)),
      cosines_(window_cosines(window_frames, window_frames)),
      whole_(prior.mean.size()),
      starts_(window_starts(frames, window_frames)) {
  const Index k = prior.coefficients();
  for (Index d = 0; d < prior.channels(); ++d) {
    whole_.segment(d * k, k) =
        (prior.rest.row(d).head(k).transpose().array() + noise_(d)).inverse();
  }
  std::map<std::vector<bool>, std::size_t> known;
  for (std::size_t w = 0; w < starts_.size(); ++w) {
    const std::vector<bool> lost = lost_samples(starts_[w], observed);
    const auto [entry, is_new] = known.try_emplace(lost, groups_.size());
    if (is_new) groups_.push_back(group_for(lost));
    groups_[entry->second].windows.push_back(w);
    owner_.push_back(entry->second);
  }
}

// N x D, 1 for missing samples of the channels that are left out; empty: none.
std::vector<bool> WienerWindows::lost_samples(Index start,
                                              std::span<const std::uint8_t> observed) const {
  const Index channels = prior_.channels();
  std::vector<bool> lost;
  for (Index d = 0; d < channels; ++d) {
    const auto missing = [&](Index i) {
      return start + i >= take_frames_ ||
             (!observed.empty() &&
              observed[static_cast<std::size_t>((start + i) * channels + d)] == 0);
    };
    Index count = 0;
    for (Index i = 0; i < frames_; ++i) count += missing(i);
    if (count * guessed_share <= frames_) continue;
    lost.resize(static_cast<std::size_t>(frames_ * channels));
    for (Index i = 0; i < frames_; ++i)
      lost[static_cast<std::size_t>(i * channels + d)] = missing(i);
  }
  return lost;
}

WindowGroup WienerWindows::group_for(const std::vector<bool>& lost) const {
  WindowGroup group;
  if (lost.empty()) return group;
  const Index channels = prior_.channels(), k = prior_.coefficients();
  for (Index d = 0; d < channels; ++d) {
    WindowGroup::Lost channel;
    channel.channel = d;
    for (Index i = 0; i < frames_; ++i) {
      if (!lost[static_cast<std::size_t>(i * channels + d)]) channel.seen.push_back(i);
    }
    if (channel.seen.size() == static_cast<std::size_t>(frames_)) continue;
    channel.precision = MatrixXd::Zero(k, k);
    for (const Index i : channel.seen) {
      const auto row = cosines_.row(i).head(k);
      channel.precision += row.transpose() * row / (noise_(d) * static_cast<double>(frames_));
    }
    const MatrixXd system = MatrixXd::Identity(k, k) +
                            channel.precision * prior_.rest.row(d).head(k).transpose().asDiagonal();
    channel.damping = system.partialPivLu().inverse();
    group.lost.push_back(std::move(channel));
  }
  return group;
}

MatrixXd WienerWindows::coefficients(const PoseMatrix& poses, std::size_t window) const {
  const Index channels = prior_.channels();
  const Index inside = std::min(frames_, take_frames_ - starts_[window]);
  const Eigen::Map<const MatrixXd> values(poses.values.data() + starts_[window] * channels,
                                          channels, inside);
  MatrixXd result = cosines_.topRows(inside).transpose() * values.transpose();
  for (Index i = inside; i < frames_; ++i)
    result += cosines_.row(i).transpose() * values.col(inside - 1).transpose();
  return result / static_cast<double>(frames_);
}

VectorXd WienerWindows::information(const PoseMatrix& poses, std::size_t window,
                                    const MatrixXd& coefficients) const {
  const Index k = prior_.coefficients(), channels = prior_.channels();
  VectorXd u(prior_.mean.size());
  for (Index d = 0; d < channels; ++d) u.segment(d * k, k) = coefficients.col(d).head(k);
  u = whole_.cwiseProduct(u - prior_.mean);
  for (const WindowGroup::Lost& lost : group_of(window).lost) {
    const Index d = lost.channel;
    VectorXd b = VectorXd::Zero(k);
    for (const Index i : lost.seen) {
      const auto row = cosines_.row(i).head(k);
      const auto frame = static_cast<std::size_t>(starts_[window] + i);
      b += row.transpose() *
           (poses(frame, static_cast<std::size_t>(d)) - row.dot(prior_.mean.segment(d * k, k)));
    }
    u.segment(d * k, k) = lost.damping * b / (noise_(d) * static_cast<double>(frames_));
  }
  return u;
}

MatrixXd WienerWindows::precision(const WindowGroup& group) const {
  const Index k = prior_.coefficients(), rank = prior_.rank();
  VectorXd weights = whole_;
  for (const WindowGroup::Lost& lost : group.lost) weights.segment(lost.channel * k, k).setZero();
  MatrixXd result = MatrixXd::Zero(rank, rank);
  result.selfadjointView<Eigen::Lower>().rankUpdate(
      (weights.cwiseSqrt().asDiagonal() * prior_.basis).transpose());
  result = MatrixXd(result.selfadjointView<Eigen::Lower>());
  for (const WindowGroup::Lost& lost : group.lost) {
    const auto rows = prior_.basis.middleRows(lost.channel * k, k);
    result += rows.transpose() * (lost.damping * lost.precision) * rows;
  }
  return result;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Component = WienerPrior::Component;

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT()
                 .diagonal()
                 .array()
                 .unaryExpr([](double x) { return portable::log(x); })
                 .sum();
}

}  // namespace

MixturePosterior mixture_posterior(const std::vector<Component>& components,
                                   const MatrixXd& precision, const MatrixXd& information) {
  const Index rank = precision.rows(), count = static_cast<Index>(components.size());
  MixturePosterior result;
  result.means.resize(components.size());
  MatrixXd evidence(information.cols(), count);
  for_each_index(components.size(), [&](std::size_t number) {
    const Component& component = components[number];
    const Eigen::LLT<MatrixXd> prior(component.covariance);
    const MatrixXd inverse = prior.solve(MatrixXd::Identity(rank, rank));
    const Eigen::LLT<MatrixXd> posterior(inverse + precision);
    const VectorXd pull = inverse * component.mean;
    const MatrixXd b = information.colwise() + pull;
    MatrixXd& mean = result.means[number];
    mean = posterior.solve(b);
    const double same =
        portable::log(component.weight) -
        0.5 * (log_determinant(prior) + log_determinant(posterior) + pull.dot(component.mean));
    evidence.col(static_cast<Index>(number)) =
        (same + 0.5 * b.cwiseProduct(mean).colwise().sum().transpose().array()).matrix();
  });
  for (Index w = 0; w < evidence.rows(); ++w) {
    evidence.row(w) =
        (evidence.row(w).array() - evidence.row(w).maxCoeff()).unaryExpr([](double x) {
          return portable::exp(x);
        });
    evidence.row(w) /= evidence.row(w).sum();
  }
  result.shares = evidence.transpose();
  return result;
}

MatrixXd MixturePosterior::mean() const {
  MatrixXd result = MatrixXd::Zero(means[0].rows(), means[0].cols());
  for (std::size_t c = 0; c < means.size(); ++c)
    result += means[c] * shares.row(static_cast<Index>(c)).asDiagonal();
  return result;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Model of a take's residual outside the learned patterns: independent coefficients whose variance
// is estimated from the take itself and scaled for each window. The noise is scaled, too: a window
// with a spike has more.
class RestModel {
 public:
  // `prior`: D x M, learned variances; `noise`: D, of a coefficient. Channels come in threes,
  // which share a scale.
  RestModel(const MatrixXd& prior, const VectorXd& noise, Index frames, double window_s);

  // Adds the residual coefficients (N x D) of a window. `counts`: D, 1 for measured channels.
  void add(const MatrixXd& left, const VectorXd& counts);
  // Adds the sums of other windows of the take.
  void add(const RestModel& other);
  // Sets the variances: those of the sums, less the noise and smoothed over frequency, where the
  // prior has the weight of eight windows. `window_weight`: weight of a window, below 1 if windows
  // overlap.
  void learn(double window_weight);
  // Posterior means of the coefficients of a window (N x D), averaged over scales of the variances
  // by their evidence, in place. The noise of a window is estimated from its highest frequencies.
  void shrink(MatrixXd& left) const;

 private:
  struct Scale {
    MatrixXd gain;         // N x D
    MatrixXd precision;    // N x D
    VectorXd log_density;  // D
  };
  int noise_octave(const MatrixXd& left, Index channel) const;

  MatrixXd prior_;             // N x D
  VectorXd noise_;             // D
  Index motionless_;           // coefficients from here on are noise
  MatrixXd signal_;            // N x D: sums of squares less their noise
  VectorXd counts_;            // D
  std::vector<Scale> scales_;  // of the motion x of the noise
};

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

// Windows overlap by three quarters, so that neighbours are dependent. By definition; chunks are
// for speed, not swept.
constexpr double window_weight = 0.25;
constexpr std::size_t chunk_windows = 16;  // task size

// sin^2, which sums to a constant for windows a quarter of their length apart.
VectorXd taper(Index frames) {
  VectorXd weights(frames);
  for (Index i = 0; i < frames; ++i) {
    const double s = portable::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                   static_cast<double>(frames));
    weights(i) = s * s;
  }
  return weights;
}

// The transpose of an Eigen matrix, as a row-major view.
nn::MatrixView transposed(const MatrixXd& matrix) {
  const auto rows = static_cast<std::size_t>(matrix.rows());
  return {matrix.data(), static_cast<std::size_t>(matrix.cols()), rows, rows};
}

// The product a b, given the transpose of a.
MatrixXd product(const nn::MatrixView& a_transposed, const MatrixXd& b) {
  MatrixXd result(static_cast<Index>(a_transposed.columns), b.cols());
  nn::multiply(transposed(b), a_transposed,
               {result.data(), static_cast<std::size_t>(b.cols()), a_transposed.columns,
                a_transposed.columns});
  return result;
}

class Filtering {
 public:
  Filtering(const WienerPrior& prior, const WienerTake& take, const WienerSettings& settings,
            Index window)
      : prior_(prior),
        take_(take),
        settings_(settings),
        windows_(prior, window, static_cast<Index>(take.poses.frames), take.observed, take.noise),
        rest_(prior.rest, windows_.noise(), window, prior.window_s),
        taper_(taper(window)),
        guess_(take.poses),
        rejected_(take.poses.values.size(), 0) {
    if (settings_.outlier_deviations > 0 && !take.suspect.empty())
      rejected_.assign(take.suspect.begin(), take.suspect.end());
    take_guesses(take.guess);
  }

  WienerResult run() {
    for (std::size_t round = 0;; ++round) {
      const bool is_last = round == settings_.rounds;
      find_posteriors();
      PoseMatrix estimate = synthesize();
      if (is_last) return {std::move(estimate), std::move(rejected_)};
      judge_samples(estimate);
      take_guesses(estimate);
    }
  }

 private:
  bool is_observed(std::size_t sample) const {
    return take_.observed.empty() || take_.observed[sample] != 0;
  }

  // Calls `work` for chunks of the windows [first, last).
  template <class Work>
  static void for_each_chunk_of(std::size_t first, std::size_t last, const Work& work) {
    const std::size_t chunks = (last - first + chunk_windows - 1) / chunk_windows;
    for_each_index(chunks, [&](std::size_t chunk) {
      const std::size_t from = first + chunk * chunk_windows;
      work(from, std::min(last, from + chunk_windows));
    });
  }

  // Calls `work` for chunks of all windows, with the number of the chunk.
  template <class Work>
  void for_each_chunk(const Work& work) const {
    for_each_chunk_of(0, windows_.starts().size(), [&](std::size_t first, std::size_t last) {
      work(first / chunk_windows, first, last);
    });
  }

  // Computes z_ for all windows.
  void find_posteriors() {
    const auto count = static_cast<Index>(windows_.starts().size());
    MatrixXd information(prior_.rank(), count);
    for_each_chunk([&](std::size_t, std::size_t first, std::size_t last) {
      MatrixXd seen(prior_.mean.size(), static_cast<Index>(last - first));
      for (std::size_t w = first; w < last; ++w) {
        seen.col(static_cast<Index>(w - first)) =
            windows_.information(guess_, w, windows_.coefficients(guess_, w));
      }
      information.middleCols(static_cast<Index>(first), seen.cols()) =
          product(transposed(prior_.basis).transposed(), seen);
    });
    z_.resize(prior_.rank(), count);
    for (const WindowGroup& group : windows_.groups()) {
      MatrixXd chosen(prior_.rank(), static_cast<Index>(group.windows.size()));
      for (std::size_t i = 0; i < group.windows.size(); ++i) {
        chosen.col(static_cast<Index>(i)) = information.col(static_cast<Index>(group.windows[i]));
      }
      const MixturePosterior posterior =
          mixture_posterior(prior_.components, windows_.precision(group), chosen);
      const MatrixXd means = posterior.mean();
      for (std::size_t i = 0; i < group.windows.size(); ++i)
        z_.col(static_cast<Index>(group.windows[i])) = means.col(static_cast<Index>(i));
    }
  }

  // K x D per window: posterior mean within the patterns.
  std::vector<MatrixXd> patterns_of(std::size_t first, std::size_t last) const {
    const MatrixXd z = z_.middleCols(static_cast<Index>(first), static_cast<Index>(last - first));
    const MatrixXd x = product(transposed(prior_.basis), z).colwise() + prior_.mean;
    std::vector<MatrixXd> patterns;
    for (Index w = 0; w < x.cols(); ++w) {
      patterns.emplace_back(
          Eigen::Map<const MatrixXd>(x.col(w).data(), prior_.coefficients(), prior_.channels()));
    }
    return patterns;
  }

  // N x D: the coefficients less that mean.
  static MatrixXd left_of(MatrixXd coefficients, const MatrixXd& pattern) {
    coefficients.topRows(pattern.rows()) -= pattern;
    return coefficients;
  }

  void learn_rest() {
    const std::size_t chunks = (windows_.starts().size() + chunk_windows - 1) / chunk_windows;
    const RestModel empty(prior_.rest, windows_.noise(), windows_.frames(), prior_.window_s);
    std::vector<RestModel> sums(chunks, empty);
    for_each_chunk([&](std::size_t chunk, std::size_t first, std::size_t last) {
      const std::vector<MatrixXd> patterns = patterns_of(first, last);
      for (std::size_t w = first; w < last; ++w) {
        VectorXd counts = VectorXd::Ones(prior_.channels());
        for (const WindowGroup::Lost& lost : windows_.group_of(w).lost) counts(lost.channel) = 0;
        sums[chunk].add(left_of(windows_.coefficients(guess_, w), patterns[w - first]), counts);
      }
    });
    rest_ = empty;
    for (const RestModel& sum : sums) rest_.add(sum);
    rest_.learn(window_weight);
  }

  // N x D: the posterior mean of a window's coefficients.
  MatrixXd window_mean(std::size_t window, const MatrixXd& pattern) const {
    const MatrixXd coefficients = windows_.coefficients(guess_, window);
    MatrixXd mean = left_of(coefficients, pattern);
    rest_.shrink(mean);
    const WindowGroup& group = windows_.group_of(window);
    if (!group.lost.empty()) {
      const Index k = prior_.coefficients();
      const VectorXd u = windows_.information(guess_, window, coefficients);
      for (const WindowGroup::Lost& lost : group.lost) {
        const Index d = lost.channel;
        const VectorXd shift = pattern.col(d) - prior_.mean.segment(d * k, k);
        mean.col(d).setZero();
        mean.col(d).head(k) = prior_.rest.row(d).head(k).transpose().cwiseProduct(
            u.segment(d * k, k) - lost.damping * (lost.precision * shift));
      }
    }
    mean.topRows(pattern.rows()) += pattern;
    return mean;
  }

  PoseMatrix synthesize() {
    learn_rest();
    const auto frames = static_cast<Index>(take_.poses.frames);
    const Index channels = prior_.channels();
    PoseMatrix sum(take_.poses.frames, take_.poses.channels);
    std::vector<double> weight(take_.poses.frames, 0.0);
    const std::vector<Index>& starts = windows_.starts();
    // A batch of windows at a time, which bounds memory.
    const std::size_t batch = 16 * chunk_windows;
    std::vector<MatrixXd> windows(std::min(batch, starts.size()));
    for (std::size_t first = 0; first < starts.size(); first += batch) {
      const std::size_t last = std::min(first + batch, starts.size());
      for_each_chunk_of(first, last, [&](std::size_t from, std::size_t to) {
        const std::vector<MatrixXd> patterns = patterns_of(from, to);
        for (std::size_t w = from; w < to; ++w) {
          windows[w - first] =
              (windows_.cosines() * window_mean(w, patterns[w - from])).transpose();
        }
      });
      for (std::size_t w = first; w < last; ++w) {
        for (Index i = 0; i < windows_.frames() && starts[w] + i < frames; ++i) {
          const auto frame = static_cast<std::size_t>(starts[w] + i);
          Eigen::Map<VectorXd>(sum.row(frame).data(), channels) +=
              taper_(i) * windows[w - first].col(i);
          weight[frame] += taper_(i);
        }
      }
    }
    for (std::size_t f = 0; f < sum.frames; ++f) {
      for (double& value : sum.row(f)) value /= weight[f];
    }
    return sum;
  }

  void judge_samples(const PoseMatrix& estimate) {
    if (settings_.outlier_deviations <= 0) return;
    const std::size_t channels = estimate.channels;
    for_each_index((channels + 2) / 3, [&](std::size_t track) {
      const std::size_t first = 3 * track, last = std::min(first + 3, channels);
      for (std::size_t d = first; d < last; ++d) {
        const double limit = limit_of(estimate, d);
        for (std::size_t f = 0; f < estimate.frames; ++f) {
          const std::size_t sample = f * channels + d;
          if (!is_observed(sample)) continue;
          if (std::abs(take_.poses(f, d) - estimate(f, d)) <= limit) continue;
          for (std::size_t other = first; other < last; ++other)
            rejected_[f * channels + other] = is_observed(f * channels + other) ? 1 : 0;
        }
      }
    });
  }

  double limit_of(const PoseMatrix& estimate, std::size_t channel) const {
    std::vector<double> distances;
    for (std::size_t f = 0; f < estimate.frames; ++f) {
      if (is_observed(f * estimate.channels + channel))
        distances.push_back(std::abs(take_.poses(f, channel) - estimate(f, channel)));
    }
    if (distances.empty()) return settings_.least_outlier_deg;
    const double spread =
        std::max(take_.noise[channel], deviations_per_median * upper_median_of(distances));
    return std::max(settings_.outlier_deviations * spread, settings_.least_outlier_deg);
  }

  void take_guesses(const PoseMatrix& estimate) {
    for (std::size_t i = 0; i < guess_.values.size(); ++i) {
      guess_.values[i] =
          is_observed(i) && rejected_[i] == 0 ? take_.poses.values[i] : estimate.values[i];
    }
  }

  const WienerPrior& prior_;
  const WienerTake& take_;
  const WienerSettings& settings_;
  WienerWindows windows_;
  RestModel rest_;
  VectorXd taper_;
  PoseMatrix guess_;  // measured samples, and estimates of missing ones
  std::vector<std::uint8_t> rejected_;
  MatrixXd z_;  // R x W
};

}  // namespace

WienerResult wiener_filter(const WienerPrior& prior, const WienerTake& take,
                           const WienerSettings& settings) {
  if (take.poses.frames == 0) return {take.poses, {}};
  // At high rates windows are at most as long as the take, as their length in frames is the
  // side of a matrix. Chosen by hand, not swept.
  constexpr double usual_rate_hz = 240;
  const double whole_take_hz = static_cast<double>(take.poses.frames) / prior.window_s;
  const double rate_hz = std::min(take.rate_hz, std::max(usual_rate_hz, whole_take_hz));
  const Index window = window_frames(prior.window_s, rate_hz);
  const WienerPrior fitting = with_coefficients(prior, window);
  return Filtering(fitting, take, settings, window).run();
}

}  // namespace kinemend
