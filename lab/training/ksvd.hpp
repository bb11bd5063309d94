// Learns dictionaries of atoms by K-SVD, and codes signals in them by orthogonal matching pursuit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "nn/gemm.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend::sparse {

/// Codes of S signals. Signal s uses the first `counts[s]` of its `most` slots.
struct SparseCodes {
  std::size_t most = 0;
  std::vector<std::uint32_t> counts;  ///< S
  std::vector<std::uint32_t> atoms;   ///< S x most
  std::vector<float> values;          ///< S x most

  SparseCodes() = default;
  SparseCodes(std::size_t signals, std::size_t most_atoms)
      : most(most_atoms),
        counts(signals, 0),
        atoms(signals * most_atoms, 0),
        values(signals * most_atoms, 0) {}
};

struct KsvdSettings {
  std::size_t atoms = 500;      ///< K, at most the number of signals
  std::size_t sparsity = 10;    ///< T: atoms of a signal, at most
  std::size_t iterations = 10;  ///< of coding and update
  /// Two atoms with a product above this are twins, one of which is replaced.
  double most_coherence = 0.99;
  std::size_t least_uses = 2;  ///< an atom in fewer signals is replaced
  std::uint64_t seed = 1;
};

struct KsvdResult {
  Dictionary dictionary;          ///< atoms of length 1
  std::vector<double> objective;  ///< |B - D W|^2 after each iteration; it never rises
};

/// The state of the iterations: all that the next one needs besides the signals.
struct KsvdState {
  Dictionary dictionary;
  SparseCodes codes;              ///< of all signals
  std::vector<float> left;        ///< S x n: signals less their codes
  std::vector<double> objective;  ///< after each iteration so far
};

/// A dictionary of the signals B (S x n) by K-SVD: the minimum of
///
///     |B - D W|_F^2,    |w_s|_0 <= T
///
/// over atoms of length 1, by turns of batch OMP and of updates of one atom after the other, each
/// by one step of a power iteration on the residual of its signals without it (Rubinstein et al.
/// 2008, algorithm 5). A signal keeps its code if pursuit finds no better one. Atoms that are
/// hardly used, and twins, become the signals that are coded worst, unless the objective does not
/// improve. The result does not depend on the number of threads. Never throws; with fewer nonzero
/// signals than atoms there are fewer atoms. `after_each` sees the state after each iteration, and
/// ends the work by returning false. Given such a state as `start`, of the same signals and
/// settings, the work resumes there with an identical result.
KsvdResult ksvd(std::span<const float> signals, std::size_t rows, const KsvdSettings& settings,
                const std::function<bool(const KsvdState&)>& after_each = {},
                const KsvdState* start = nullptr);

struct OmpSettings {
  std::size_t most_atoms = 10;  ///< T, 1 or more
  /// A signal is done when the norm of its residual is at most this.
  double residual = 0;
};

/// Orthogonal matching pursuit for many signals (Rubinstein, Zibulevsky, Elad 2008, "Efficient
/// Implementation of the K-SVD Algorithm using Batch Orthogonal Matching Pursuit", algorithm 2):
/// atoms are chosen greedily by their correlation with the residual, which is updated by the Gram
/// matrix alone,
///
///     alpha = alpha_0 - G_I gamma,    alpha_0 = D^T z,    G = D^T D
///
/// where gamma = G_II^-1 alpha_0,I by a Cholesky factor that grows by a row with each atom.
class BatchOmp {
 public:
  /// Atoms have length 1; one of zeros is never chosen. The dictionary is not kept.
  explicit BatchOmp(const Dictionary& dictionary);

  /// `signals`: S x n. Signals are coded in parallel. Never throws; an atom that is, within
  /// rounding, a sum of those chosen ends the code of a signal.
  SparseCodes code(std::span<const float> signals, const OmpSettings& settings) const;

  /// K x K
  std::span<const float> gram() const noexcept { return gram_; }

 private:
  void code_block(std::span<const float> signals, std::size_t first, std::size_t last,
                  const OmpSettings& settings, SparseCodes& codes) const;

  std::size_t rows_, atoms_;
  nn::PackedMatrixF atoms_by_row_;  // n x K
  std::vector<float> gram_;
};

}  // namespace kinemend::sparse
