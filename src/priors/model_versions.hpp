#pragma once

#include <array>
#include <string_view>

namespace kinemend {

/// The newest version of each method's tensors and numbers that this program reads and writes.
struct ModelVersion {
  std::string_view method;
  int newest;
};
inline constexpr std::array<ModelVersion, 3> model_versions = {
    {{"example", 1}, {"wiener", 1}, {"kalman-learned", 1}}};

}  // namespace kinemend
