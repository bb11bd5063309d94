// Codes the signals, updates the atoms one after the other, and replaces those that are hardly
// used.
#include "papers/xiao2015_sparse/ksvd.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "kinemend/experimental/random.hpp"
#include "papers/xiao2015_sparse/batch_omp.hpp"

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

}  // namespace kinemend::sparse
