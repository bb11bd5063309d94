// Solves the l2/l1 and l1/l1 problems of Xiao et al. 2015 to a proven gap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend::sparse {

enum class Loss : std::uint8_t {
  squares,   ///< sum_i w_i r_i^2: eq. 4 of Xiao et al. 2015
  absolute,  ///< sum_i w_i |r_i|: eq. 5
};

/// S problems of one dictionary,
///
///     min over theta of  sum_i w_i |z_i - (D theta)_i|^p + lambda |theta|_1,    p = 2 or 1
///
/// Rows of weight 0 are missing: they do not affect the result.
struct SparseProblem {
  Loss loss = Loss::squares;
  std::span<const double> signals;  ///< S x n: z
  std::span<const double> weights;  ///< S x n, not negative; empty: all 1
  std::span<const double> lambdas;  ///< S, positive
  std::span<const double> start;    ///< S x K: codes to start from; empty: none
};

struct DualSettings {
  /// A signal is done when its duality gap is at most this share of its objective, or of that of
  /// the code of zeros.
  double tolerance = 1e-2;
  std::size_t iterations = 1000;  ///< at most, for each set of atoms
  std::size_t first_atoms = 8;    ///< per signal, with which its batch starts
  std::size_t rounds = 20;        ///< in which atoms are added, at most
  std::size_t batch = 4;          ///< neighbouring signals that are solved together
};

struct SparseSolution {
  std::vector<double> codes;          ///< S x K, sparse
  std::vector<double> reconstructed;  ///< S x n: D theta
  std::vector<double> gaps;           ///< S: a bound on how far an objective is above its minimum
  std::vector<double> objectives;     ///< S

  /// All zeros, without gaps.
  SparseSolution(const Dictionary& dictionary, std::size_t signals)
      : codes(signals * dictionary.atoms),
        reconstructed(signals * dictionary.rows),
        objectives(signals) {}
};

/// Solves them by a dual augmented Lagrangian method (Yang & Zhang 2011, "Alternating direction
/// algorithms for l1-problems in compressive sensing"; the DALM that the paper refers to): with f*
/// the conjugate of the loss, the dual is
///
///     max over y of  y^T z - f*(y),    |D^T y|_inf <= lambda
///
/// and the augmented Lagrangian is minimised by turns over y, over s = D^T y and over t = y; theta
/// and the residual are the multipliers of the two. Missing rows and weights affect f* alone, so
/// that signals share one factor of I + D^T D and an iteration is four products of matrices.
/// Penalties adapt to each signal. A batch holds a few neighbouring signals, which are alike if
/// windows overlap, and starts with the atoms that correlate with it the most; atoms whose dual
/// constraint the solution breaks are added until all hold (working sets; multipliers are kept).
/// Batches run in parallel; the result does not depend on the number of threads.
SparseSolution solve_sparse(const Dictionary& dictionary, const SparseProblem& problem,
                            const DualSettings& settings = {});

}  // namespace kinemend::sparse
