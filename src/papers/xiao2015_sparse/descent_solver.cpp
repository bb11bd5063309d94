// Solves batches of signals by descent and adds the atoms whose slope exceeds lambda.
#include "papers/xiao2015_sparse/descent_solver.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "nn/gemm.hpp"

namespace kinemend::sparse {

namespace {

using Vector = Eigen::VectorXf;
using Map = Eigen::Map<const Eigen::VectorXf>;

// For speed, not swept.
constexpr std::size_t batch_signals = 64;  // task size
// For the absolute loss, residuals are at least this share of their median, so that weights stay
// finite. Chosen by hand, not swept.
constexpr float least_rest = 0.1F;

// One signal: the atoms it uses, with their products under the weights of its rows.
class Descent {
 public:
  Descent(const Dictionary& dictionary, const Map& signal, const DescentSettings& settings)
      : dictionary_(dictionary), signal_(signal), settings_(settings) {}

  void start(std::size_t atom, float code) {
    if (code == 0 || used_.size() >= settings_.most_atoms) return;
    append(atom, code);
  }

  // Sets the weights of rows, half of those of the squares' slope. Removes atoms without a code.
  void weigh(const Vector& weights) {
    weights_ = weights;
    const std::vector<std::size_t> atoms = std::exchange(used_, {});
    const std::vector<float> codes = std::exchange(codes_, {});
    columns_.clear();
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      if (codes[i] != 0) append(atoms[i], codes[i]);
    }
    const Eigen::MatrixXf weighted = weights_.asDiagonal() * columns();
    products_.resize(most(), most());
    products_.topLeftCorner(size(), size()).noalias() = weighted.transpose() * columns();
    targets_.resize(most());
    targets_.head(size()).noalias() = weighted.transpose() * signal_;
  }

  bool uses(std::size_t atom) const {
    return std::find(used_.begin(), used_.end(), atom) != used_.end();
  }

  bool use(std::size_t atom) {
    if (used_.size() >= settings_.most_atoms || uses(atom)) return false;
    append(atom, 0);
    const Vector weighted = weights_.cwiseProduct(atom_of(atom));
    const Eigen::Index last = size() - 1;
    products_.col(last).head(size()).noalias() = columns().transpose() * weighted;
    products_.row(last).head(last) = products_.col(last).head(last).transpose();
    targets_[last] = weighted.dot(signal_);
    return true;
  }

  // Coordinate descent on the atoms in use, minimising code^T G code - 2 target^T code + lambda
  // |code|_1. Slopes are updated for the few codes that change.
  void descend(float lambda) {
    const Eigen::Index n = size();
    Eigen::Map<Vector> codes(codes_.data(), n);
    Vector slopes = targets_.head(n) - products_.topLeftCorner(n, n) * codes;
    for (std::size_t sweep = 0; sweep < settings_.sweeps; ++sweep) {
      float moved = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        const float own = products_(i, i);
        if (!(own > 0)) continue;
        const float slope = slopes[i] + own * codes[i];
        const float size = std::max(std::abs(slope) - 0.5F * lambda, 0.0F) / own;
        const float change = (slope < 0 ? -size : size) - codes[i];
        if (change == 0) continue;
        moved = std::max(moved, 2 * own * std::abs(change));
        slopes -= change * products_.col(i).head(n);
        codes[i] += change;
      }
      if (moved <= static_cast<float>(settings_.tolerance) * lambda) break;
    }
  }

  Vector fit() const { return columns() * Map(codes_.data(), size()); }

  const Vector& weights() const { return weights_; }
  Map signal() const { return signal_; }
  template <class Use>
  void for_each_code(const Use& use) const {
    for (std::size_t i = 0; i < used_.size(); ++i) use(used_[i], codes_[i]);
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(used_.size()); }
  Eigen::Index most() const { return static_cast<Eigen::Index>(settings_.most_atoms); }
  Map atom_of(std::size_t k) const {
    return {dictionary_.values.data() + k * dictionary_.rows,
            static_cast<Eigen::Index>(dictionary_.rows)};
  }
  Eigen::Map<const Eigen::MatrixXf> columns() const {
    return {columns_.data(), static_cast<Eigen::Index>(dictionary_.rows), size()};
  }
  void append(std::size_t atom, float code) {
    used_.push_back(atom);
    codes_.push_back(code);
    const std::span<const float> values = dictionary_.atom(atom);
    columns_.insert(columns_.end(), values.begin(), values.end());
  }

  const Dictionary& dictionary_;
  Map signal_;
  const DescentSettings& settings_;
  Vector weights_, targets_;
  std::vector<std::size_t> used_;
  std::vector<float> codes_, columns_;  // columns: the atoms in use, one after the other
  Eigen::MatrixXf products_;            // their Gram matrix under the weights
};

// Signals first to last of a problem.
class DescentBatch {
 public:
  DescentBatch(const Dictionary& dictionary, const nn::PackedMatrixF& by_row,
               const SparseProblem& problem, const DescentSettings& settings, std::size_t first,
               std::size_t last)
      : dictionary_(dictionary),
        by_row_(by_row),
        problem_(problem),
        settings_(settings),
        first_(first),
        count_(last - first),
        rows_(dictionary.rows),
        signals_(problem.signals.begin() + static_cast<std::ptrdiff_t>(first * rows_),
                 problem.signals.begin() + static_cast<std::ptrdiff_t>(last * rows_)) {
    for (std::size_t s = 0; s < count_; ++s)
      descents_.emplace_back(dictionary, Map(signals_.data() + s * rows_, size()), settings);
  }

  void solve() {
    for (std::size_t s = 0; s < count_ && !problem_.start.empty(); ++s) {
      for (std::size_t k = 0; k < dictionary_.atoms; ++k)
        descents_[s].start(
            k, static_cast<float>(problem_.start[(first_ + s) * dictionary_.atoms + k]));
    }
    const std::size_t turns = problem_.loss == Loss::squares ? 1 : settings_.turns;
    for (std::size_t turn = 0; turn < turns; ++turn) {
      for (std::size_t s = 0; s < count_; ++s) descents_[s].weigh(weights_of(s, turn));
      solve_squares();
    }
  }

  void store(SparseSolution& solution) const {
    for (std::size_t s = 0; s < count_; ++s) {
      double sum = 0;
      descents_[s].for_each_code([&](std::size_t atom, float code) {
        solution.codes[(first_ + s) * dictionary_.atoms + atom] = code;
        sum += std::abs(static_cast<double>(code));
      });
      const Vector fit = descents_[s].fit();
      double loss = 0;
      for (std::size_t r = 0; r < rows_; ++r) {
        const double value = fit[static_cast<Eigen::Index>(r)];
        const std::size_t i = (first_ + s) * rows_ + r;
        const double left = problem_.signals[i] - value;
        loss +=
            given_weight(s, r) * (problem_.loss == Loss::squares ? left * left : std::abs(left));
        solution.reconstructed[i] = value;
      }
      solution.objectives[first_ + s] = loss + problem_.lambdas[first_ + s] * sum;
    }
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_); }
  double given_weight(std::size_t s, std::size_t row) const {
    return problem_.weights.empty() ? 1 : problem_.weights[(first_ + s) * rows_ + row];
  }

  // The weights of the squares in this turn.
  Vector weights_of(std::size_t s, std::size_t turn) const {
    Vector weights(size());
    for (std::size_t r = 0; r < rows_; ++r)
      weights[static_cast<Eigen::Index>(r)] = static_cast<float>(given_weight(s, r));
    if (problem_.loss == Loss::squares) return weights;
    const Vector left = (descents_[s].signal() - descents_[s].fit()).cwiseAbs();
    std::vector<double> sizes;
    for (Eigen::Index r = 0; r < left.size(); ++r) {
      if (weights[r] > 0) sizes.push_back(static_cast<double>(left[r]));
    }
    const auto middle = static_cast<float>(median_of(sizes));
    if (!(middle > 0)) return weights;
    // The first turn has no residuals that distinguish samples.
    if (turn == 0) return weights / (2 * middle);
    return weights.array() / (2 * left.array().max(least_rest * middle));
  }

  void solve_squares() {
    std::vector<float> slopes(count_ * dictionary_.atoms), left(count_ * rows_);
    for (std::size_t round = 0; round < settings_.rounds; ++round) {
      for (std::size_t s = 0; s < count_; ++s) {
        Eigen::Map<Vector> own(left.data() + s * rows_, size());
        own = descents_[s].weights().cwiseProduct(descents_[s].signal() - descents_[s].fit());
      }
      nn::multiply(
          nn::MatrixViewF{left.data(), count_, rows_, rows_}, by_row_,
          nn::MutableMatrixViewF{slopes.data(), count_, dictionary_.atoms, dictionary_.atoms});
      bool grew = false;
      for (std::size_t s = 0; s < count_; ++s) {
        const auto lambda = static_cast<float>(problem_.lambdas[first_ + s]);
        const bool added =
            add_steep({slopes.data() + s * dictionary_.atoms, dictionary_.atoms}, lambda, s);
        if (added || round == 0) descents_[s].descend(lambda);
        grew = grew || added;
      }
      if (!grew) break;
    }
  }

  // Adds the few steepest atoms whose slope exceeds lambda.
  bool add_steep(std::span<const float> slopes, float lambda, std::size_t s) {
    // For speed, not swept.
    constexpr std::size_t at_once = 6;  // atoms
    const float limit = 0.5F * lambda * (1 + static_cast<float>(settings_.tolerance));
    std::vector<std::pair<float, std::size_t>> steep;
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      if (std::abs(slopes[k]) > limit && !descents_[s].uses(k))
        steep.emplace_back(-std::abs(slopes[k]), k);
    }
    const std::size_t many = std::min(at_once, steep.size());
    std::partial_sort(steep.begin(), steep.begin() + static_cast<std::ptrdiff_t>(many),
                      steep.end());
    bool added = false;
    for (std::size_t i = 0; i < many; ++i) added |= descents_[s].use(steep[i].second);
    return added;
  }

  const Dictionary& dictionary_;
  const nn::PackedMatrixF& by_row_;
  const SparseProblem& problem_;
  const DescentSettings& settings_;
  std::size_t first_, count_, rows_;
  std::vector<float> signals_;
  std::vector<Descent> descents_;
};

}  // namespace

SparseSolution descend_sparse(const Dictionary& dictionary, const SparseProblem& problem,
                              const DescentSettings& settings) {
  const std::size_t count = problem.lambdas.size();
  SparseSolution solution(dictionary, count);
  if (count == 0 || dictionary.atoms == 0) return solution;
  const nn::PackedMatrixF by_row(
      nn::MatrixViewF{dictionary.values.data(), dictionary.atoms, dictionary.rows, dictionary.rows}
          .transposed());
  for_each_parallel((count + batch_signals - 1) / batch_signals, problem.signals.size() * 16,
                    [&](std::size_t b) {
                      DescentBatch batch(dictionary, by_row, problem, settings, b * batch_signals,
                                         std::min(count, (b + 1) * batch_signals));
                      batch.solve();
                      batch.store(solution);
                    });
  return solution;
}

}  // namespace kinemend::sparse
