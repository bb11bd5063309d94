// Learns a dictionary: codes the signals, updates the atoms one after the other, and replaces those
// that are hardly used. Codes by choosing atoms one by one by the Gram matrix, with a Cholesky
// factor that grows with them.
#include "papers/xiao2015_sparse/dictionary.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::sparse {

namespace {

using Vector = Eigen::VectorXf;
using Column = Eigen::Map<Eigen::VectorXf>;
using ConstColumn = Eigen::Map<const Eigen::VectorXf>;

// For speed, not swept.
constexpr std::size_t block_of_signals = 256;  // task size; it fixes the order of sums

ConstColumn column(std::span<const float> values, std::size_t number, std::size_t rows) {
  return {values.data() + number * rows, static_cast<Eigen::Index>(rows)};
}

ConstColumn column(const std::vector<float>& values, std::size_t number, std::size_t rows) {
  return {values.data() + number * rows, static_cast<Eigen::Index>(rows)};
}

Column column(std::vector<float>& values, std::size_t number, std::size_t rows) {
  return {values.data() + number * rows, static_cast<Eigen::Index>(rows)};
}

// Calls `work(first, last)` for blocks of signals and sums in their order, whatever the threads.
template <class Work>
double sum_over_blocks(std::size_t signals, std::size_t rows, const Work& work) {
  const std::size_t blocks = (signals + block_of_signals - 1) / block_of_signals;
  std::vector<double> sums(blocks, 0);
  for_each_parallel(blocks, signals * rows, [&](std::size_t b) {
    sums[b] = work(b * block_of_signals, std::min(signals, (b + 1) * block_of_signals));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// A use of an atom: slot `slot` of all codes belongs to signal slot / most.
using Uses = std::vector<std::vector<std::size_t>>;

class Learning {
 public:
  Learning(std::span<const float> signals, std::size_t rows, const KsvdSettings& settings)
      : signals_(signals),
        rows_(rows),
        count_(rows == 0 ? 0 : signals.size() / rows),
        settings_(settings) {
    draw_atoms();
    state_.codes =
        SparseCodes(count_, std::min({settings.sparsity, state_.dictionary.atoms, rows}));
    state_.left.assign(signals.begin(), signals.end());
    objective_ = energy();
  }

  Learning(std::span<const float> signals, std::size_t rows, const KsvdSettings& settings,
           const KsvdState& start)
      : signals_(signals),
        rows_(rows),
        count_(rows == 0 ? 0 : signals.size() / rows),
        settings_(settings),
        state_(start) {
    objective_ = energy();
  }

  bool is_done() const {
    return state_.dictionary.atoms == 0 || state_.objective.size() >= settings_.iterations;
  }
  const KsvdState& state() const { return state_; }

  // One turn of coding and update.
  void iterate() {
    if (!code_with_replacements()) code();
    update_atoms();
    objective_ = energy();
    state_.objective.push_back(objective_);
  }

  KsvdResult finish() { return {std::move(state_.dictionary), std::move(state_.objective)}; }

 private:
  // Draws different signals at random as atoms.
  void draw_atoms() {
    std::vector<std::size_t> order(count_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random random(settings_.seed);
    for (std::size_t i = count_; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    state_.dictionary.rows = rows_;
    for (const std::size_t s : order) {
      if (state_.dictionary.atoms == settings_.atoms) break;
      const ConstColumn signal = column(signals_, s, rows_);
      if (signal.norm() <= 0) continue;
      state_.dictionary.values.resize(state_.dictionary.values.size() + rows_);
      column(state_.dictionary.values, state_.dictionary.atoms++, rows_) = signal / signal.norm();
    }
  }

  double energy() const {
    return sum_over_blocks(count_, rows_, [&](std::size_t first, std::size_t last) {
      double sum = 0;
      for (std::size_t s = first; s < last; ++s)
        sum += static_cast<double>(column(state_.left, s, rows_).squaredNorm());
      return sum;
    });
  }

  // The residual of a signal after its code.
  Vector rest_of(const Dictionary& dictionary, const SparseCodes& codes, std::size_t s) const {
    Vector rest = column(signals_, s, rows_);
    for (std::size_t i = s * codes.most; i < s * codes.most + codes.counts[s]; ++i)
      rest -= codes.values[i] * column(dictionary.values, codes.atoms[i], rows_);
    return rest;
  }

  bool uses_any(std::size_t s, const std::vector<bool>& atoms) const {
    for (std::size_t i = s * state_.codes.most; i < s * state_.codes.most + state_.codes.counts[s];
         ++i) {
      if (atoms[state_.codes.atoms[i]]) return true;
    }
    return false;
  }

  // Codes all signals. A signal keeps an old code that has none of the `changed` atoms and leaves
  // less. Returns the objective.
  double code_by(const Dictionary& dictionary, const std::vector<bool>& changed, SparseCodes& codes,
                 std::vector<float>& left) const {
    OmpSettings settings;
    settings.most_atoms = state_.codes.most;
    SparseCodes found = BatchOmp(dictionary).code(signals_, settings);
    return sum_over_blocks(count_, rows_, [&](std::size_t first, std::size_t last) {
      double sum = 0;
      for (std::size_t s = first; s < last; ++s) {
        const Vector rest = rest_of(dictionary, found, s);
        if (uses_any(s, changed) || rest.squaredNorm() < column(left, s, rows_).squaredNorm()) {
          column(left, s, rows_) = rest;
          take_code(found, s, codes);
        }
        sum += static_cast<double>(column(left, s, rows_).squaredNorm());
      }
      return sum;
    });
  }

  static void take_code(const SparseCodes& from, std::size_t s, SparseCodes& to) {
    const auto first = static_cast<std::ptrdiff_t>(s * to.most);
    const auto count = static_cast<std::ptrdiff_t>(from.counts[s]);
    to.counts[s] = from.counts[s];
    std::copy_n(from.atoms.begin() + first, count, to.atoms.begin() + first);
    std::copy_n(from.values.begin() + first, count, to.values.begin() + first);
  }

  void code() {
    const std::vector<bool> none(state_.dictionary.atoms, false);
    code_by(state_.dictionary, none, state_.codes, state_.left);
  }

  // Codes after replacing poor atoms; false if there are no poor atoms or the objective does not
  // improve.
  bool code_with_replacements() {
    const std::vector<bool> replaced = poor_atoms();
    if (std::find(replaced.begin(), replaced.end(), true) == replaced.end()) return false;
    Dictionary dictionary = state_.dictionary;
    std::vector<std::pair<float, std::size_t>> worst(count_);
    for (std::size_t s = 0; s < count_; ++s)
      worst[s] = {-column(std::as_const(state_.left), s, rows_).squaredNorm(), s};
    const auto many = static_cast<std::size_t>(std::count(replaced.begin(), replaced.end(), true));
    const std::size_t needed = std::min(many, count_);
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(needed),
                      worst.end());
    std::size_t next = 0;
    for (std::size_t k = 0; k < replaced.size() && next < needed; ++k) {
      if (!replaced[k]) continue;
      const ConstColumn signal = column(signals_, worst[next++].second, rows_);
      if (signal.norm() > 0) column(dictionary.values, k, rows_) = signal / signal.norm();
    }
    SparseCodes codes = state_.codes;
    std::vector<float> left = state_.left;
    if (code_by(dictionary, replaced, codes, left) > objective_) return false;
    state_.dictionary = std::move(dictionary);
    state_.codes = std::move(codes);
    state_.left = std::move(left);
    return true;
  }

  Uses uses() const {
    Uses result(state_.dictionary.atoms);
    for (std::size_t s = 0; s < count_; ++s) {
      for (std::size_t i = s * state_.codes.most;
           i < s * state_.codes.most + state_.codes.counts[s]; ++i)
        result[state_.codes.atoms[i]].push_back(i);
    }
    return result;
  }

  // Marks hardly used atoms, and of twins the one that is used less; none before the first coding.
  std::vector<bool> poor_atoms() const {
    std::vector<bool> poor(state_.dictionary.atoms, false);
    if (std::all_of(state_.codes.counts.begin(), state_.codes.counts.end(),
                    [](auto n) { return n == 0; }))
      return poor;
    const Uses by_atom = uses();
    const BatchOmp products(state_.dictionary);
    const std::span<const float> gram = products.gram();
    for (std::size_t k = 0; k < poor.size(); ++k) {
      if (by_atom[k].size() < settings_.least_uses) poor[k] = true;
      for (std::size_t j = 0; j < k && !poor[k]; ++j) {
        if (poor[j] || std::abs(gram[k * poor.size() + j]) <= settings_.most_coherence) continue;
        poor[by_atom[j].size() < by_atom[k].size() ? j : k] = true;
      }
    }
    return poor;
  }

  void update_atoms() {
    const Uses by_atom = uses();
    for (std::size_t k = 0; k < by_atom.size(); ++k) {
      if (!by_atom[k].empty()) update_atom(k, by_atom[k]);
    }
  }

  void update_atom(std::size_t k, const std::vector<std::size_t>& slots) {
    const Vector old = column(state_.dictionary.values, k, rows_);
    Vector direction = Vector::Zero(static_cast<Eigen::Index>(rows_));
    for (const std::size_t slot : slots) {
      const float value = state_.codes.values[slot];
      direction += value * (column(state_.left, slot / state_.codes.most, rows_) + value * old);
    }
    const float length = direction.norm();
    if (!(length > 0)) return;
    direction /= length;
    const float turn = old.dot(direction);
    for (const std::size_t slot : slots) {
      Column left = column(state_.left, slot / state_.codes.most, rows_);
      float& value = state_.codes.values[slot];
      const float next = left.dot(direction) + value * turn;
      left += value * old - next * direction;
      value = next;
    }
    column(state_.dictionary.values, k, rows_) = direction;
  }

  std::span<const float> signals_;
  std::size_t rows_, count_;
  KsvdSettings settings_;
  KsvdState state_;
  double objective_ = 0;  // valid before the first iteration, too
};

}  // namespace

KsvdResult ksvd(std::span<const float> signals, std::size_t rows, const KsvdSettings& settings,
                const std::function<bool(const KsvdState&)>& after_each, const KsvdState* start) {
  Learning learning = start != nullptr ? Learning(signals, rows, settings, *start)
                                       : Learning(signals, rows, settings);
  while (!learning.is_done()) {
    learning.iterate();
    if (after_each && !after_each(learning.state())) break;
  }
  return learning.finish();
}

namespace {

constexpr std::size_t block_signals = 128;  // task size
// Share of an atom's squared length outside the chosen atoms; less is rounding.
constexpr float least_new_share = 1e-6F;
constexpr float least_correlation = 1e-7F;  // of the signal's length

// The pursuit of one signal; its memory is reused for the next.
class Pursuit {
 public:
  Pursuit(std::span<const float> gram, std::size_t atoms, std::size_t most)
      : gram_(gram), atoms_(atoms), left_(atoms), factor_(most * most), code_(most), work_(most) {
    chosen_.reserve(most);
  }

  // `correlations`: K, one per atom with the signal.
  void run(std::span<const float> correlations, double energy, const OmpSettings& settings) {
    chosen_.clear();
    std::copy(correlations.begin(), correlations.end(), left_.begin());
    const double enough = settings.residual * settings.residual;
    const float floor = least_correlation * static_cast<float>(std::sqrt(energy));
    double residual = energy;
    while (chosen_.size() < code_.size() && residual > enough) {
      const std::size_t atom = largest();
      if (std::abs(left_[atom]) <= floor || !add_row(atom)) break;
      solve(correlations);
      residual = energy - explained(correlations);
      if (chosen_.size() < code_.size()) update(correlations);
    }
  }

  void store(SparseCodes& codes, std::size_t signal) const {
    codes.counts[signal] = static_cast<std::uint32_t>(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      codes.atoms[signal * codes.most + i] = static_cast<std::uint32_t>(chosen_[i]);
      codes.values[signal * codes.most + i] = code_[i];
    }
  }

 private:
  float& factor(std::size_t row, std::size_t column) {
    return factor_[row * code_.size() + column];
  }

  std::size_t largest() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < atoms_; ++k) {
      if (std::abs(left_[k]) > std::abs(left_[best])) best = k;
    }
    return best;
  }

  // Adds a row to the Cholesky factor; false for an atom that depends on the chosen ones.
  bool add_row(std::size_t atom) {
    const std::size_t n = chosen_.size();
    float left = gram_[atom * atoms_ + atom];
    for (std::size_t i = 0; i < n; ++i) {
      if (chosen_[i] == atom) return false;
      float sum = gram_[atom * atoms_ + chosen_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= factor(i, j) * factor(n, j);
      factor(n, i) = sum / factor(i, i);
      left -= factor(n, i) * factor(n, i);
    }
    if (left <= least_new_share) return false;
    factor(n, n) = std::sqrt(left);
    chosen_.push_back(atom);
    return true;
  }

  void solve(std::span<const float> correlations) {
    const std::size_t n = chosen_.size();
    for (std::size_t i = 0; i < n; ++i) {
      float sum = correlations[chosen_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= factor(i, j) * work_[j];
      work_[i] = sum / factor(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
      float sum = work_[i];
      for (std::size_t j = i + 1; j < n; ++j) sum -= factor(j, i) * code_[j];
      code_[i] = sum / factor(i, i);
    }
  }

  double explained(std::span<const float> correlations) const {
    double sum = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      sum += static_cast<double>(code_[i]) * static_cast<double>(correlations[chosen_[i]]);
    return sum;
  }

  void update(std::span<const float> correlations) {
    std::copy(correlations.begin(), correlations.end(), left_.begin());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const float* const row = gram_.data() + chosen_[i] * atoms_;
      const float value = code_[i];
      for (std::size_t k = 0; k < atoms_; ++k) left_[k] -= value * row[k];
    }
    for (const std::size_t atom : chosen_) left_[atom] = 0;
  }

  std::span<const float> gram_;
  std::size_t atoms_;
  std::vector<float> left_;          // K: correlations with the residual
  std::vector<float> factor_;        // lower triangle
  std::vector<float> code_, work_;   // T
  std::vector<std::size_t> chosen_;  // atoms, in their order
};

}  // namespace

BatchOmp::BatchOmp(const Dictionary& dictionary)
    : rows_(dictionary.rows),
      atoms_(dictionary.atoms),
      atoms_by_row_(nn::MatrixViewF{dictionary.values.data(), dictionary.atoms, dictionary.rows,
                                    dictionary.rows}
                        .transposed()),
      gram_(dictionary.atoms * dictionary.atoms) {
  const nn::MatrixViewF atoms{dictionary.values.data(), atoms_, rows_, rows_};
  nn::multiply_symmetric(atoms, atoms.transposed(), {gram_.data(), atoms_, atoms_, atoms_});
}

void BatchOmp::code_block(std::span<const float> signals, std::size_t first, std::size_t last,
                          const OmpSettings& settings, SparseCodes& codes) const {
  const std::size_t count = last - first;
  std::vector<float> correlations(count * atoms_);
  nn::multiply(nn::MatrixViewF{signals.data() + first * rows_, count, rows_, rows_}, atoms_by_row_,
               nn::MutableMatrixViewF{correlations.data(), count, atoms_, atoms_});
  Pursuit pursuit(gram_, atoms_, codes.most);
  for (std::size_t s = first; s < last; ++s) {
    double energy = 0;
    for (std::size_t r = 0; r < rows_; ++r) {
      const double value = signals[s * rows_ + r];
      energy += value * value;
    }
    pursuit.run({correlations.data() + (s - first) * atoms_, atoms_}, energy, settings);
    pursuit.store(codes, s);
  }
}

SparseCodes BatchOmp::code(std::span<const float> signals, const OmpSettings& settings) const {
  const std::size_t count = rows_ == 0 ? 0 : signals.size() / rows_;
  SparseCodes codes(count, std::min({settings.most_atoms, atoms_, rows_}));
  if (codes.most == 0) return codes;
  const std::size_t blocks = (count + block_signals - 1) / block_signals;
  for_each_parallel(blocks, signals.size(), [&](std::size_t b) {
    code_block(signals, b * block_signals, std::min(count, (b + 1) * block_signals), settings,
               codes);
  });
  return codes;
}

}  // namespace kinemend::sparse
