// Groups windows by their missing samples, computes the likelihood of the coefficients, and weights
// the components by their evidence.
#include "methods/wiener/wiener_windows.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <map>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "methods/prior/window_bases.hpp"

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

}  // namespace kinemend
