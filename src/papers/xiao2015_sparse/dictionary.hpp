// A dictionary of atoms, in which signals are sums of few. `lab/training/ksvd.hpp` learns it.
#pragma once

#include <cstddef>
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

}  // namespace kinemend::sparse
