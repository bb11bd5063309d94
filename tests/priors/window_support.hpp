#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>

#include "kinemend/random.hpp"
#include "priors/window_bases.hpp"

namespace kinemend {

// M' L x K
inline Eigen::MatrixXd matrix_of(const WindowBases& bases) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      bases.values.data(), bases.frames * bases.channels, bases.count);
}

// Independent, of no length in particular.
inline WindowBases random_bases(std::size_t frames, std::size_t hop, std::size_t channels,
                                std::size_t count, std::uint64_t seed) {
  Random random(seed);
  WindowBases bases{frames, hop, channels, count, {}, false};
  bases.values.resize(frames * channels * count);
  for (double& value : bases.values) value = random.normal();
  return bases;
}

}  // namespace kinemend
