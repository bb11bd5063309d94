// Solves batches of signals on working sets of atoms that grow until all constraints hold. Iterates
// the dual augmented Lagrangian method on a batch, and measures the gap of each signal.
#include "papers/xiao2015_sparse/dual_solver.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "nn/gemm.hpp"

namespace kinemend::sparse {

namespace {

// The dual augmented Lagrangian method for a batch of S signals on the atoms of a set, which can
// grow: multipliers are kept.
class DualBatch {
 public:
  // `signals`, `weights`: S x n; they must outlive the batch.
  DualBatch(Loss loss, std::size_t rows, std::span<const double> signals,
            std::span<const double> weights, std::span<const double> lambdas);

  // Continues with this set of atoms (A x n): the previous atoms in their order, then new ones.
  // `codes` (S x A) holds the codes of the new atoms; the current codes replace those of the
  // others.
  void set_atoms(std::vector<double> atoms, const std::vector<double>& codes);
  // Iterates until every gap is small enough for the atoms of the set, or for
  // `settings.iterations`.
  void iterate(const DualSettings& settings);

  const std::vector<double>& codes() const noexcept { return codes_; }        // S x A
  const std::vector<double>& reconstructed() const noexcept { return fit_; }  // S x n
  // S x n: t, feasible for the conjugate of the loss.
  const std::vector<double>& duals() const noexcept { return doubles_; }
  double objective(std::size_t s) const { return objectives_[s]; }
  // The gap of signal s, with its dual scaled so that the largest correlation, `most`, becomes at
  // most lambda.
  double gap(std::size_t s, double most) const;
  bool is_done(std::size_t s, double gap, double tolerance) const;

 private:
  void start_from_codes();
  void step();
  void step_signal(std::size_t s);
  void balance();
  bool measure(double tolerance);
  double loss_of(std::size_t s, bool of_zero) const;

  Loss loss_;
  std::size_t rows_, count_, atoms_ = 0;
  std::span<const double> signals_, weights_, lambdas_;
  nn::PackedMatrix by_atom_, by_row_, gram_, inverse_;  // A x n, n x A, A x A, (I + D^T D)^-1
  std::vector<double> penalties_;                       // S: beta
  std::vector<double> codes_, bounds_, correlations_;   // S x A: theta, s, D^T y
  std::vector<double> rests_, doubles_, duals_;         // S x n: r, t, y
  std::vector<double> fit_;                             // S x n: D theta
  std::vector<double> base_, projected_, combined_;
  std::vector<double> objectives_, empty_objectives_, primal_, dual_;  // S
};

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

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Relaxation of the alternating directions, above 1 for fewer rounds; rounds from one measurement
// of the gap to the next, for speed. Not swept.
constexpr double over_relaxation = 1.6;
constexpr std::size_t measured_every = 10;
// Penalties are adapted only so long; the method converges once they are fixed. Chosen by hand, not
// swept.
constexpr std::size_t balanced_until = 300;
// Ratio of the two residuals from which a penalty is changed, and by how much. Chosen by hand, not
// swept.
constexpr double balance_ratio = 3, balance_factor = 2;

double clipped(double value, double size) { return std::clamp(value, -size, size); }

DualBatch::DualBatch(Loss loss, std::size_t rows, std::span<const double> signals,
                     std::span<const double> weights, std::span<const double> lambdas)
    : loss_(loss),
      rows_(rows),
      count_(lambdas.size()),
      signals_(signals),
      weights_(weights),
      lambdas_(lambdas),
      penalties_(count_),
      rests_(signals.begin(), signals.end()),
      doubles_(signals.size()),
      duals_(signals.size()),
      fit_(signals.size()),
      base_(signals.size()),
      objectives_(count_),
      empty_objectives_(count_),
      primal_(count_),
      dual_(count_) {
  for (std::size_t s = 0; s < count_; ++s) {
    double size = 0, weight = 0;
    for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
      size += weights_[i] > 0 ? std::abs(signals_[i]) : 0;
      weight += weights_[i];
    }
    // The penalty starts at the ratio of a residual to its multiplier.
    const double slope = loss_ == Loss::squares ? 0.5 * static_cast<double>(rows_) : size;
    penalties_[s] = slope > 0 && weight > 0 ? slope / weight : 1;
    empty_objectives_[s] = loss_of(s, true);
  }
}

void DualBatch::set_atoms(std::vector<double> atoms, const std::vector<double>& codes) {
  const bool is_first = atoms_ == 0;
  const std::size_t before = std::exchange(atoms_, rows_ == 0 ? 0 : atoms.size() / rows_);
  std::vector<double> known = std::exchange(codes_, codes);
  for (std::size_t s = 0; s < count_; ++s)
    std::copy_n(known.begin() + static_cast<std::ptrdiff_t>(s * before), before,
                codes_.begin() + static_cast<std::ptrdiff_t>(s * atoms_));
  const nn::MatrixView by_atom{atoms.data(), atoms_, rows_, rows_};
  by_atom_ = nn::PackedMatrix(by_atom);
  by_row_ = nn::PackedMatrix(by_atom.transposed());
  const auto size = static_cast<Eigen::Index>(atoms_);
  Matrix gram(size, size);
  nn::multiply_symmetric(by_atom, by_atom.transposed(), {gram.data(), atoms_, atoms_, atoms_});
  gram_ = nn::PackedMatrix(nn::MatrixView{gram.data(), atoms_, atoms_, atoms_});
  gram.diagonal().array() += 1;
  const Matrix inverse = gram.llt().solve(Matrix::Identity(size, size));
  inverse_ = nn::PackedMatrix(nn::MatrixView{inverse.data(), atoms_, atoms_, atoms_});

  correlations_.assign(count_ * atoms_, 0);
  projected_.assign(count_ * atoms_, 0);
  combined_.assign(count_ * atoms_, 0);
  bounds_.assign(count_ * atoms_, 0);
  if (is_first) start_from_codes();
  nn::multiply({doubles_.data(), count_, rows_, rows_}, by_row_,
               {bounds_.data(), count_, atoms_, atoms_});
  for (std::size_t i = 0; i < bounds_.size(); ++i)
    bounds_[i] = clipped(bounds_[i], lambdas_[i / atoms_]);
}

void DualBatch::start_from_codes() {
  nn::multiply({codes_.data(), count_, atoms_, atoms_}, by_atom_,
               {fit_.data(), count_, rows_, rows_});
  for (std::size_t i = 0; i < rests_.size(); ++i) {
    rests_[i] = signals_[i] - fit_[i];
    const double slow = rests_[i] / penalties_[i / rows_];
    doubles_[i] = loss_ == Loss::squares ? 2 * weights_[i] * rests_[i] : clipped(slow, weights_[i]);
  }
}

void DualBatch::step() {
  for (std::size_t s = 0; s < count_; ++s) {
    const double over = 1 / penalties_[s];
    for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i)
      base_[i] = over * (signals_[i] - rests_[i]) + doubles_[i];
    for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i)
      combined_[i] = bounds_[i] - over * codes_[i];
  }
  // y = (I + D D^T)^-1 (base + D c), by the inverse of the smaller I + D^T D.
  nn::multiply({base_.data(), count_, rows_, rows_}, by_row_,
               {projected_.data(), count_, atoms_, atoms_});
  nn::multiply({combined_.data(), count_, atoms_, atoms_}, gram_,
               {projected_.data(), count_, atoms_, atoms_}, nn::Product::add);
  nn::multiply({projected_.data(), count_, atoms_, atoms_}, inverse_,
               {correlations_.data(), count_, atoms_, atoms_});
  for (std::size_t i = 0; i < combined_.size(); ++i) combined_[i] -= correlations_[i];
  duals_ = base_;
  nn::multiply({combined_.data(), count_, atoms_, atoms_}, by_atom_,
               {duals_.data(), count_, rows_, rows_}, nn::Product::add);
  for (std::size_t s = 0; s < count_; ++s) step_signal(s);
}

// Updates the other two blocks and the multipliers, over-relaxed, and notes how far they moved.
void DualBatch::step_signal(std::size_t s) {
  const double beta = penalties_[s], lambda = lambdas_[s], over = 1 / beta;
  double apart = 0, moved = 0, multipliers = 0, sizes = 0;
  const auto note = [&](double y, double split, double before, double multiplier) {
    apart += (y - split) * (y - split);
    sizes += split * split;
    moved += (split - before) * (split - before);
    multipliers += multiplier * multiplier;
  };
  for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i) {
    const double before = bounds_[i];
    const double relaxed = over_relaxation * correlations_[i] + (1 - over_relaxation) * before;
    const double v = relaxed + over * codes_[i];
    bounds_[i] = clipped(v, lambda);
    codes_[i] = beta * (v - bounds_[i]);
    note(correlations_[i], bounds_[i], before, codes_[i]);
  }
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    const double before = doubles_[i];
    const double relaxed = over_relaxation * duals_[i] + (1 - over_relaxation) * before;
    const double u = relaxed + over * rests_[i];
    const double stiff = 2 * weights_[i] * beta;
    doubles_[i] = loss_ == Loss::squares ? u * stiff / (1 + stiff) : clipped(u, weights_[i]);
    rests_[i] = beta * (u - doubles_[i]);
    note(duals_[i], doubles_[i], before, rests_[i]);
  }
  primal_[s] = sizes > 0 ? std::sqrt(apart / sizes) : 0;
  dual_[s] = multipliers > 0 ? beta * std::sqrt(moved / multipliers) : 0;
}

void DualBatch::balance() {
  for (std::size_t s = 0; s < count_; ++s) {
    if (primal_[s] > balance_ratio * dual_[s]) penalties_[s] *= balance_factor;
    if (dual_[s] > balance_ratio * primal_[s]) penalties_[s] /= balance_factor;
  }
}

double DualBatch::loss_of(std::size_t s, bool of_zero) const {
  double sum = 0;
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    const double left = signals_[i] - (of_zero ? 0 : fit_[i]);
    sum += weights_[i] * (loss_ == Loss::squares ? left * left : std::abs(left));
  }
  return sum;
}

double DualBatch::gap(std::size_t s, double most) const {
  double product = 0, conjugate = 0;
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    product += doubles_[i] * signals_[i];
    if (loss_ == Loss::squares && weights_[i] > 0)
      conjugate += doubles_[i] * doubles_[i] / (4 * weights_[i]);
  }
  double scale = most > lambdas_[s] ? lambdas_[s] / most : 1;
  if (loss_ == Loss::squares && conjugate > 0) {
    const double largest = most > 0 ? lambdas_[s] / most : product / (2 * conjugate);
    scale = std::clamp(product / (2 * conjugate), 0.0, std::max(largest, 0.0));
  }
  return objectives_[s] - (scale * product - scale * scale * conjugate);
}

bool DualBatch::is_done(std::size_t s, double gap, double tolerance) const {
  return gap <= tolerance * std::min(objectives_[s], empty_objectives_[s]);
}

bool DualBatch::measure(double tolerance) {
  nn::multiply({codes_.data(), count_, atoms_, atoms_}, by_atom_,
               {fit_.data(), count_, rows_, rows_});
  nn::multiply({doubles_.data(), count_, rows_, rows_}, by_row_,
               {projected_.data(), count_, atoms_, atoms_});
  bool all = true;
  for (std::size_t s = 0; s < count_; ++s) {
    double most = 0, sum = 0;
    for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i) {
      most = std::max(most, std::abs(projected_[i]));
      sum += std::abs(codes_[i]);
    }
    objectives_[s] = loss_of(s, false) + lambdas_[s] * sum;
    all = all && is_done(s, gap(s, most), tolerance);
  }
  return all;
}

void DualBatch::iterate(const DualSettings& settings) {
  for (std::size_t i = 1; i <= settings.iterations; ++i) {
    step();
    if (i % measured_every != 0 && i != settings.iterations) continue;
    if (measure(settings.tolerance)) return;
    if (i <= balanced_until) balance();
  }
}

}  // namespace

}  // namespace kinemend::sparse
