// Solves batches of signals on working sets of atoms that grow until all constraints hold.
#include "papers/xiao2015_sparse/dual_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.hpp"
#include "nn/gemm.hpp"
#include "papers/xiao2015_sparse/dual_batch.hpp"

namespace kinemend::sparse {

namespace {

// All atoms; every batch needs them.
struct Atoms {
  std::size_t rows, count;
  std::vector<double> values;  // K x n
  nn::PackedMatrix by_row;     // n x K

  explicit Atoms(const Dictionary& dictionary)
      : rows(dictionary.rows),
        count(dictionary.atoms),
        values(dictionary.values.begin(), dictionary.values.end()),
        by_row(nn::MatrixView{values.data(), count, rows, rows}.transposed()) {}

  // S x K
  std::vector<double> correlations(std::span<const double> signals,
                                   std::size_t signal_count) const {
    std::vector<double> result(signal_count * count);
    nn::multiply({signals.data(), signal_count, rows, rows}, by_row,
                 {result.data(), signal_count, count, count});
    return result;
  }
};

// The atoms that a batch is solved on: chosen[i] is the i-th.
class WorkingSet {
 public:
  WorkingSet(const Atoms& atoms, std::size_t signals)
      : atoms_(atoms), signals_(signals), is_chosen_(atoms.count, false) {}

  void add(std::size_t atom) {
    if (is_chosen_[atom]) return;
    is_chosen_[atom] = true;
    chosen_.push_back(atom);
  }
  bool has(std::size_t atom) const { return is_chosen_[atom]; }
  const std::vector<std::size_t>& chosen() const { return chosen_; }

  void hand_to(DualBatch& batch, std::span<const double> start) const {
    std::vector<double> values, codes(signals_ * chosen_.size(), 0);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const auto first =
          atoms_.values.begin() + static_cast<std::ptrdiff_t>(chosen_[i] * atoms_.rows);
      values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(atoms_.rows));
      for (std::size_t s = 0; s < signals_ && !start.empty(); ++s)
        codes[s * chosen_.size() + i] = start[s * atoms_.count + chosen_[i]];
    }
    batch.set_atoms(std::move(values), codes);
  }

 private:
  const Atoms& atoms_;
  std::size_t signals_;
  std::vector<bool> is_chosen_;
  std::vector<std::size_t> chosen_;
};

// Adds the atoms of the `many` largest values above a floor.
void add_largest(std::span<const double> values, double floor, std::size_t many,
                 WorkingSet& working) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k]) > floor && !working.has(k)) order.push_back(k);
  }
  many = std::min(many, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(many), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double x = std::abs(values[a]), y = std::abs(values[b]);
                      return x != y ? x > y : a < b;
                    });
  for (std::size_t i = 0; i < many; ++i) working.add(order[i]);
}

// One batch: signals first to last of a problem.
struct SignalBatch {
  const Atoms& atoms;
  const SparseProblem& problem;
  std::span<const double> weights;  // of all signals
  std::size_t first, last;

  std::size_t count() const { return last - first; }
  std::span<const double> part(std::span<const double> values, std::size_t width) const {
    return values.empty() ? values : values.subspan(first * width, count() * width);
  }
};

WorkingSet first_atoms(const SignalBatch& batch, std::size_t many) {
  WorkingSet working(batch.atoms, batch.count());
  const std::size_t rows = batch.atoms.rows, all = batch.atoms.count;
  const std::span<const double> signals = batch.part(batch.problem.signals, rows);
  const std::span<const double> weights = batch.part(batch.weights, rows);
  const std::span<const double> start = batch.part(batch.problem.start, all);
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (start[i] != 0) working.add(i % all);
  }
  std::vector<double> seen(signals.size());
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = weights[i] > 0 ? signals[i] : 0;
  const std::vector<double> correlations = batch.atoms.correlations(seen, batch.count());
  for (std::size_t s = 0; s < batch.count(); ++s) {
    const std::span<const double> own(correlations.data() + s * all, all);
    add_largest(own, 0, start.empty() ? many : many / 2, working);
  }
  return working;
}

// Adds the atoms whose constraint |d^T y| <= lambda the solution breaks; notes each signal's gap.
bool add_broken(const SignalBatch& batch, const DualBatch& solver, const DualSettings& settings,
                WorkingSet& working, SparseSolution& solution) {
  const std::size_t all = batch.atoms.count, before = working.chosen().size();
  const std::vector<double> correlations = batch.atoms.correlations(solver.duals(), batch.count());
  for (std::size_t s = 0; s < batch.count(); ++s) {
    const std::span<const double> own(correlations.data() + s * all, all);
    double most = 0;
    for (const double value : own) most = std::max(most, std::abs(value));
    const double gap = solver.gap(s, most);
    solution.gaps[batch.first + s] = gap;
    solution.objectives[batch.first + s] = solver.objective(s);
    if (!solver.is_done(s, gap, settings.tolerance))
      add_largest(own, batch.problem.lambdas[batch.first + s], settings.first_atoms, working);
  }
  return working.chosen().size() > before;
}

void solve_batch(const SignalBatch& batch, const DualSettings& settings, SparseSolution& solution) {
  const std::size_t rows = batch.atoms.rows, all = batch.atoms.count;
  WorkingSet working = first_atoms(batch, std::max<std::size_t>(settings.first_atoms, 1));
  DualBatch solver(batch.problem.loss, rows, batch.part(batch.problem.signals, rows),
                   batch.part(batch.weights, rows), batch.part(batch.problem.lambdas, 1));
  std::vector<std::size_t> solved;
  for (std::size_t round = 0; round < std::max<std::size_t>(settings.rounds, 1); ++round) {
    working.hand_to(solver, batch.part(batch.problem.start, all));
    solver.iterate(settings);
    solved = working.chosen();
    if (!add_broken(batch, solver, settings, working, solution)) break;
  }
  for (std::size_t s = 0; s < batch.count(); ++s) {
    for (std::size_t i = 0; i < solved.size(); ++i)
      solution.codes[(batch.first + s) * all + solved[i]] = solver.codes()[s * solved.size() + i];
  }
  std::copy(solver.reconstructed().begin(), solver.reconstructed().end(),
            solution.reconstructed.begin() + static_cast<std::ptrdiff_t>(batch.first * rows));
}

}  // namespace

SparseSolution solve_sparse(const Dictionary& dictionary, const SparseProblem& problem,
                            const DualSettings& settings) {
  const std::size_t count = problem.lambdas.size();
  SparseSolution solution(dictionary, count);
  solution.gaps.assign(count, 0);
  if (count == 0 || dictionary.atoms == 0) return solution;
  const Atoms atoms(dictionary);
  std::vector<double> ones;
  if (problem.weights.empty()) ones.assign(problem.signals.size(), 1);
  const std::span<const double> weights = problem.weights.empty() ? ones : problem.weights;
  const std::size_t width = std::max<std::size_t>(settings.batch, 1);
  for_each_parallel((count + width - 1) / width, problem.signals.size() * 64, [&](std::size_t b) {
    solve_batch({atoms, problem, weights, b * width, std::min(count, (b + 1) * width)}, settings,
                solution);
  });
  return solution;
}

}  // namespace kinemend::sparse
