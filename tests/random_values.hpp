// Draws normal numbers for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend::test {

/// Normal numbers with deviation 1.
inline std::vector<double> random_values(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values(count);
  for (double& value : values) value = random.normal();
  return values;
}

}  // namespace kinemend::test
