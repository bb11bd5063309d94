// Dictionaries of atoms, and sparse codes of signals in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinemend::sparse {

/// K atoms of n rows each, one after the other.
struct Dictionary {
  std::size_t rows = 0;       ///< n
  std::size_t atoms = 0;      ///< K
  std::vector<float> values;  ///< K x n

  std::span<float> atom(std::size_t k) { return {values.data() + k * rows, rows}; }
  std::span<const float> atom(std::size_t k) const { return {values.data() + k * rows, rows}; }
};

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

}  // namespace kinemend::sparse
