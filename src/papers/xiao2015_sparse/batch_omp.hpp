// Orthogonal matching pursuit for many signals: a sparse code of each in a dictionary.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nn/gemm.hpp"
#include "papers/xiao2015_sparse/dictionary.hpp"

namespace kinemend::sparse {

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
