// Random signals and dictionaries for tests of sparse codes.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend::sparse {

inline std::vector<float> random_values(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random.normal());
  return values;
}

inline Dictionary random_dictionary(std::size_t rows, std::size_t atoms, std::uint64_t seed) {
  Dictionary dictionary{rows, atoms, random_values(rows * atoms, seed)};
  for (std::size_t k = 0; k < atoms; ++k) {
    double sum = 0;
    for (const float value : dictionary.atom(k)) sum += static_cast<double>(value) * value;
    for (float& value : dictionary.atom(k)) value /= static_cast<float>(std::sqrt(sum));
  }
  return dictionary;
}

/// n x K
inline Eigen::MatrixXd matrix_of(const Dictionary& dictionary) {
  return Eigen::Map<const Eigen::MatrixXf>(dictionary.values.data(),
                                           static_cast<Eigen::Index>(dictionary.rows),
                                           static_cast<Eigen::Index>(dictionary.atoms))
      .cast<double>();
}

}  // namespace kinemend::sparse
