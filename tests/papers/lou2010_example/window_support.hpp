// Random bases, and bases as Eigen matrices, for tests of `example`.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "papers/lou2010_example/filter_bases.hpp"
#include "random_values.hpp"

namespace kinemend {

// An M' L x K matrix.
inline Eigen::MatrixXd matrix_of(const WindowBases& bases) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      bases.values.data(), bases.frames * bases.channels, bases.count);
}

// Independent bases of any length.
inline WindowBases random_bases(std::size_t frames, std::size_t hop, std::size_t channels,
                                std::size_t count, std::uint64_t seed) {
  return {frames, hop, channels, count, test::random_values(frames * channels * count, seed),
          false};
}

}  // namespace kinemend
