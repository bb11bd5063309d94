// Learns dictionaries from signals by K-SVD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "papers/xiao2015_sparse/dictionary.hpp"

namespace kinemend::sparse {

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

}  // namespace kinemend::sparse
