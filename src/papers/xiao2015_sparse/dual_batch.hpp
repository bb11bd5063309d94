// The inner loop of the exact solver: a few signals on the atoms that they need.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nn/gemm.hpp"
#include "papers/xiao2015_sparse/dual_solver.hpp"

namespace kinemend::sparse {

/// The dual augmented Lagrangian method for a batch of S signals on the atoms of a set, which can
/// grow: multipliers are kept.
class DualBatch {
 public:
  /// `signals`, `weights`: S x n; they must outlive the batch.
  DualBatch(Loss loss, std::size_t rows, std::span<const double> signals,
            std::span<const double> weights, std::span<const double> lambdas);

  /// Continues with this set of atoms (A x n): the previous atoms in their order, then new ones.
  /// `codes` (S x A) holds the codes of the new atoms; the current codes replace those of the
  /// others.
  void set_atoms(std::vector<double> atoms, const std::vector<double>& codes);
  /// Iterates until every gap is small enough for the atoms of the set, or for
  /// `settings.iterations`.
  void iterate(const DualSettings& settings);

  const std::vector<double>& codes() const noexcept { return codes_; }        ///< S x A
  const std::vector<double>& reconstructed() const noexcept { return fit_; }  ///< S x n
  /// S x n: t, feasible for the conjugate of the loss.
  const std::vector<double>& duals() const noexcept { return doubles_; }
  double objective(std::size_t s) const { return objectives_[s]; }
  /// The gap of signal s, with its dual scaled so that the largest correlation, `most`, becomes at
  /// most lambda.
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

}  // namespace kinemend::sparse
