// Solves sparse problems quickly, by coordinate descent on the atoms in use.
#pragma once

#include "learned/sparse/dual_solver.hpp"

namespace kinemend::sparse {

struct DescentSettings {
  /// A round of the atoms in use ends when none changes the objective's slope by more than this
  /// share of lambda; an atom is taken into use when its slope is above lambda by that.
  double tolerance = 1e-2;
  std::size_t sweeps = 200;     ///< over the atoms in use, at most
  std::size_t rounds = 20;      ///< of atoms that are taken into use, at most
  std::size_t most_atoms = 60;  ///< in use for one signal, at most
  /// Of the absolute loss: turns of weights, from the first, which are all of the squares.
  std::size_t turns = 6;
};

/// The problems of `solve_sparse`, quickly: each signal by coordinate descent on the few atoms that
/// it uses, of which alone the Gram matrix is made; those whose slope is beyond lambda come into
/// use, and slopes are found for all signals of a batch by one product. The absolute loss is
/// majorised by squares,
///
///     |r| <= r^2 / (2 |r_0|) + |r_0| / 2
///
/// with r_0 what the turn before left, which is a few problems of squares from a warm start; it is
/// near the minimum, not in it. `gaps` are empty.
SparseSolution descend_sparse(const Dictionary& dictionary, const SparseProblem& problem,
                              const DescentSettings& settings = {});

}  // namespace kinemend::sparse
