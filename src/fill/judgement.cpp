#include "fill/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinemend::fill {

namespace {

// Exponents of the ratios of mean square differences, for the choice and for the expected error:
// from gaps made in the takes that docs/methods/fill.md names.
constexpr double choice_exponent = 0.6;
constexpr double error_exponent = 0.7;
// A model's mean square error has to be so much less than a curve's to count as much.
constexpr double clearly_better = 3;
// The error is as often above as below the root mean square of few trials; it is stated a little
// above, for what no trial has shown.
constexpr double caution = 1.25;
constexpr double least_ratio = 1.0 / 16, most_ratio = 1e4;

using Matrix = Eigen::MatrixXd;
using Indices = std::vector<Eigen::Index>;

Indices of_kind(std::span<const CandidateKind> kinds, CandidateKind kind) {
  Indices found;
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    if (kinds[c] == kind) found.push_back(static_cast<Eigen::Index>(c));
  }
  return found;
}

// Mean square distance of the candidates from the average of them with these weights.
double spread_about(const Matrix& products, const Indices& candidates,
                    const Eigen::VectorXd& weights) {
  const Eigen::VectorXd with_average = products * weights;
  const double average = weights.dot(with_average);
  double sum = 0;
  for (const Eigen::Index c : candidates) sum += products(c, c) - 2 * with_average[c] + average;
  return std::max(0.0, sum / static_cast<double>(candidates.size()));
}

Eigen::VectorXd evenly_over(const Indices& candidates, Eigen::Index count) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  for (const Eigen::Index c : candidates) weights[c] = 1 / static_cast<double>(candidates.size());
  return weights;
}

double square_distance(const Matrix& products, Eigen::Index a, Eigen::Index b) {
  return std::max(0.0, products(a, a) + products(b, b) - 2 * products(a, b));
}

// How much `difference(products)` is greater in the gap than in the trials.
template <class Difference>
double ratio_of(const Matrix& gap, std::span<const Matrix> trials, double floor,
                const Difference& difference) {
  double sum = 0;
  for (const Matrix& trial : trials) sum += difference(trial);
  const double usual = sum / static_cast<double>(trials.size()) + floor;
  if (!(usual > 0)) return 1;
  return std::clamp((difference(gap) + floor) / usual, least_ratio, most_ratio);
}

// The mean square error that is to be expected of each candidate.
class Squares {
 public:
  Squares(std::span<const CandidateKind> kinds, const Matrix& gap, std::span<const Matrix> trials,
          double floor)
      : gap_(gap), trials_(trials), floor_(floor) {
    values_.assign(kinds.size(), std::numeric_limits<double>::infinity());
    judge_models(of_kind(kinds, CandidateKind::model));
    const Indices lines = of_kind(kinds, CandidateKind::line);
    for (const Eigen::Index c : of_kind(kinds, CandidateKind::curve)) judge_curve(c, lines);
    const double favour = of_kind(kinds, CandidateKind::model).empty() ? 1 : clearly_better;
    for (const Eigen::Index c : of_kind(kinds, CandidateKind::curve)) at(c) /= favour;
  }

  const std::vector<double>& values() const { return values_; }

 private:
  double& at(Eigen::Index c) { return values_[static_cast<std::size_t>(c)]; }

  void judge_models(const Indices& models) {
    if (models.empty()) return;
    const Eigen::VectorXd even = evenly_over(models, gap_.rows());
    const double ratio = ratio_of(gap_, trials_, floor_, [&](const Matrix& products) {
      return spread_about(products, models, even);
    });
    const double harder = std::pow(ratio, choice_exponent);
    for (const Eigen::Index c : models) {
      double sum = 0;
      for (const Matrix& trial : trials_) sum += trial(c, c);
      at(c) = harder * sum / static_cast<double>(trials_.size());
    }
  }

  // Its typical error: one trial that went astray says nothing against it.
  void judge_curve(Eigen::Index c, const Indices& lines) {
    double sum = 0;
    for (const Matrix& trial : trials_) sum += std::log(trial(c, c) + 0.01 * floor_ + 1e-300);
    at(c) = std::exp(sum / static_cast<double>(trials_.size()));
    if (lines.empty()) return;
    const double ratio = ratio_of(gap_, trials_, floor_, [&](const Matrix& products) {
      return square_distance(products, c, lines.front());
    });
    at(c) *= std::pow(ratio, choice_exponent);
  }

  const Matrix& gap_;
  std::span<const Matrix> trials_;
  double floor_;
  std::vector<double> values_;
};

Eigen::VectorXd weights_of(const std::vector<double>& squares, double floor) {
  const double least = *std::min_element(squares.begin(), squares.end()) + floor;
  Eigen::VectorXd weights(static_cast<Eigen::Index>(squares.size()));
  for (std::size_t c = 0; c < squares.size(); ++c) {
    const double square = squares[c] + floor;
    const double share = square > 0 ? least / square : 1;
    weights[static_cast<Eigen::Index>(c)] = share * share;
  }
  return weights / weights.sum();
}

}  // namespace

Eigen::MatrixXd products_of(const std::vector<std::vector<Vec3>>& proposals,
                            std::span<const Vec3> origin) {
  const auto count = static_cast<Eigen::Index>(proposals.size());
  Matrix offsets(count, static_cast<Eigen::Index>(3 * origin.size()));
  for (Eigen::Index c = 0; c < count; ++c) {
    for (std::size_t i = 0; i < origin.size(); ++i) {
      const Vec3 off = proposals[static_cast<std::size_t>(c)][i] - origin[i];
      const auto column = static_cast<Eigen::Index>(3 * i);
      offsets(c, column) = off.x, offsets(c, column + 1) = off.y, offsets(c, column + 2) = off.z;
    }
  }
  return offsets * offsets.transpose() / static_cast<double>(origin.size());
}

Judgement judge(std::span<const CandidateKind> kinds, const Eigen::MatrixXd& gap,
                std::span<const Eigen::MatrixXd> trials, double longer, double grain) {
  const double floor = grain * grain;
  const Squares squares(kinds, gap, trials, floor);
  const Eigen::VectorXd weights = weights_of(squares.values(), floor);
  Indices used;
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    if (kinds[c] != CandidateKind::line) used.push_back(static_cast<Eigen::Index>(c));
  }
  // A curve alone is compared with the line.
  const bool alone = used.size() < 2;
  double sum = 0;
  for (const Matrix& trial : trials) sum += std::max(0.0, weights.dot(trial * weights));
  const double ratio = ratio_of(gap, trials, 0.25 * floor, [&](const Matrix& products) {
    return alone ? spread_about(products, of_kind(kinds, CandidateKind::line), weights)
                 : spread_about(products, used, weights);
  });
  const double square =
      longer * sum / static_cast<double>(trials.size()) * std::pow(ratio, error_exponent) + floor;
  return {{weights.data(), weights.data() + weights.size()}, caution * std::sqrt(square)};
}

}  // namespace kinemend::fill
