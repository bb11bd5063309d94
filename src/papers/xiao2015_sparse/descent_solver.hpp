// Solves sparse problems quickly, by coordinate descent on the atoms in use.
#pragma once

#include "papers/xiao2015_sparse/dual_solver.hpp"

namespace kinemend::sparse {

struct DescentSettings {
  /// A round of the atoms in use ends when none changes the objective's slope by more than this
  /// share of lambda; an atom is added when its slope exceeds lambda by that share.
  double tolerance = 1e-2;
  std::size_t sweeps = 200;     ///< over the atoms in use, at most
  std::size_t rounds = 20;      ///< in which atoms are added, at most
  std::size_t most_atoms = 60;  ///< in use for one signal, at most
  /// Turns of reweighted squares for the absolute loss. The first turn has equal weights.
  std::size_t turns = 6;
};

/// A fast solver of the problems of `solve_sparse`: coordinate descent for each signal on the few
/// atoms that it uses, so that only their Gram matrix is needed. Atoms whose slope exceeds lambda
/// are added; one product gives the slopes for all signals of a batch. The absolute loss is
/// majorised by squares,
///
///     |r| <= r^2 / (2 |r_0|) + |r_0| / 2
///
/// with r_0 the residual of the turn before: a few problems of squares from a warm start. The
/// result is near the minimum, not exactly in it. `gaps` are empty.
SparseSolution descend_sparse(const Dictionary& dictionary, const SparseProblem& problem,
                              const DescentSettings& settings = {});

}  // namespace kinemend::sparse
