// Scales the errors of trials by how much the candidates differ in the gap, and weights the
// candidates by them.
#include "fill/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable.hpp"

namespace kinemend::fill {

namespace {

// Exponents of the ratios of mean square differences, for the choice and for the expected error:
// differences of candidates from each other, and from the straight line. They and `caution` are
// regressed from artificial gaps in the takes that docs/methods/fill.md names; the bounds of the
// ratio are not swept.
constexpr double choice_exponent = 0.5;
constexpr double error_exponent = 0.5, line_exponent = 0.3;
// Few trials miss the worst case, so the expected error is raised above their root mean square.
constexpr double caution = 1.45, caution_at_end = 2;
constexpr double least_ratio = 1.0 / 16, most_ratio = 1e4;
// Shares of the squared grain, added to the spline's square error and to the differences that scale
// the expected error. Not swept.
constexpr double spline_floor = 0.01, error_floor = 0.25;

using Matrix = Eigen::MatrixXd;
using Indices = std::vector<Eigen::Index>;

template <class Accept>
Indices indices_of(std::span<const CandidateKind> kinds, const Accept& accept) {
  Indices found;
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    if (accept(kinds[c])) found.push_back(static_cast<Eigen::Index>(c));
  }
  return found;
}

Indices lines_among(std::span<const CandidateKind> kinds) {
  return indices_of(kinds, [](CandidateKind kind) { return kind == CandidateKind::line; });
}

// Returns the mean square distance of the candidates from their average with these weights.
double spread_about(const Matrix& products, const Indices& candidates,
                    const Eigen::VectorXd& weights) {
  const Eigen::VectorXd with_average = products * weights;
  const double average = weights.dot(with_average);
  double sum = 0;
  for (const Eigen::Index c : candidates) sum += products(c, c) - 2 * with_average[c] + average;
  return std::max(0.0, sum / static_cast<double>(candidates.size()));
}

double square_distance(const Matrix& products, Eigen::Index a, Eigen::Index b) {
  return std::max(0.0, products(a, a) + products(b, b) - 2 * products(a, b));
}

double mean_over(const std::vector<Matrix>& trials, const auto& value) {
  double sum = 0;
  for (const Matrix& trial : trials) sum += value(trial);
  return sum / static_cast<double>(trials.size());
}

// Returns the ratio of `difference(products)` in the gap to its mean in the trials.
double ratio_of(const Matrix& gap, const std::vector<Matrix>& trials, double floor,
                const auto& difference) {
  const double usual = mean_over(trials, difference) + floor;
  if (!(usual > 0)) return 1;
  return std::clamp((difference(gap) + floor) / usual, least_ratio, most_ratio);
}

}  // namespace

Eigen::MatrixXd products_of(const Proposals& offsets) {
  const auto count = static_cast<Eigen::Index>(offsets.size());
  const std::size_t frames = offsets.empty() ? 0 : offsets.front().size();
  Matrix rows(count, static_cast<Eigen::Index>(3 * frames));
  for (Eigen::Index c = 0; c < count; ++c) {
    for (std::size_t i = 0; i < frames; ++i) {
      const Vec3 off = offsets[static_cast<std::size_t>(c)][i];
      const auto column = static_cast<Eigen::Index>(3 * i);
      rows(c, column) = off.x, rows(c, column + 1) = off.y, rows(c, column + 2) = off.z;
    }
  }
  return rows * rows.transpose() / static_cast<double>(frames);
}

Judgement::Judgement(std::vector<CandidateKind> kinds, Eigen::MatrixXd gap, Trials trials,
                     double grain)
    : kinds_(std::move(kinds)),
      gap_(std::move(gap)),
      trials_(std::move(trials)),
      floor_(grain * grain),
      squares_(kinds_.size(), std::numeric_limits<double>::infinity()) {
  judge_models();
  for (std::size_t c = 0; c < kinds_.size(); ++c) {
    if (kinds_[c] == CandidateKind::spline || kinds_[c] == CandidateKind::curve) judge_curve(c);
  }
}

void Judgement::judge_models() {
  const Indices models =
      indices_of(kinds_, [](CandidateKind kind) { return kind == CandidateKind::model; });
  if (models.empty()) return;
  Eigen::VectorXd even = Eigen::VectorXd::Zero(gap_.rows());
  for (const Eigen::Index c : models) even[c] = 1 / static_cast<double>(models.size());
  const double ratio = ratio_of(gap_, trials_.products, floor_, [&](const Matrix& products) {
    return spread_about(products, models, even);
  });
  const double harder = portable::pow(ratio, choice_exponent);
  for (const Eigen::Index c : models) {
    squares_[static_cast<std::size_t>(c)] =
        harder * mean_over(trials_.products, [&](const Matrix& trial) { return trial(c, c); });
  }
}

void Judgement::judge_curve(std::size_t candidate) {
  const auto c = static_cast<Eigen::Index>(candidate);
  double& square = squares_[candidate];
  if (kinds_[candidate] == CandidateKind::spline) {
    square = portable::exp(mean_over(trials_.products, [&](const Matrix& trial) {
      return portable::log(trial(c, c) + spline_floor * floor_ +
                           std::numeric_limits<double>::min());
    }));
  } else {
    square = mean_over(trials_.products, [&](const Matrix& trial) { return trial(c, c); });
  }
  const Indices lines = lines_among(kinds_);
  if (lines.empty()) return;
  const double ratio = ratio_of(gap_, trials_.products, floor_, [&](const Matrix& products) {
    return square_distance(products, c, lines.front());
  });
  square *= portable::pow(ratio, choice_exponent);
}

std::vector<double> Judgement::weights(double favour) const {
  std::vector<double> squares = squares_;
  for (std::size_t c = 0; c < squares.size(); ++c) {
    if (kinds_[c] == CandidateKind::spline) squares[c] /= favour;
  }
  const double least = *std::min_element(squares.begin(), squares.end()) + floor_;
  std::vector<double> weights;
  double sum = 0;
  for (const double square : squares) {
    const double share = square + floor_ > 0 ? least / (square + floor_) : 1;
    weights.push_back(share * share);
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double Judgement::expected_error(std::span<const double> weights) const {
  const Eigen::Map<const Eigen::VectorXd> w(weights.data(),
                                            static_cast<Eigen::Index>(weights.size()));
  // A single candidate is compared with the line.
  Indices others =
      indices_of(kinds_, [](CandidateKind kind) { return kind != CandidateKind::line; });
  if (others.size() < 2) others = lines_among(kinds_);
  double harder = 1;
  if (!others.empty()) {
    const double ratio =
        ratio_of(gap_, trials_.products, error_floor * floor_,
                 [&](const Matrix& products) { return spread_about(products, others, w); });
    harder = portable::pow(ratio, error_exponent);
  }
  // A gap in which the track turns farther than in the trials is harder. A straighter one may only
  // look so because its filling misses the turn.
  if (const Indices lines = lines_among(kinds_); !lines.empty()) {
    const double ratio =
        ratio_of(gap_, trials_.products, error_floor * floor_,
                 [&](const Matrix& products) { return spread_about(products, lines, w); });
    harder *= portable::pow(std::max(1.0, ratio), line_exponent);
  }
  const double square = mean_over(
      trials_.products, [&](const Matrix& trial) { return std::max(0.0, w.dot(trial * w)); });
  return (trials_.at_end ? caution_at_end : caution) *
         std::sqrt(trials_.longer * square * harder + floor_);
}

}  // namespace kinemend::fill
