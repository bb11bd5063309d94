// Damages and cleans markers, for tests of quality.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/methods.hpp"
#include "quality/quality.hpp"
#include "registry/marker_takes.hpp"

namespace kinemend::quality {

inline Take cleaned_markers(const Take& clip, std::string_view method,
                            const OptionValues& options = {}) {
  return clean_take(clip, *make_cleaner(method, options)).take;
}

/// Typical damage: white noise of `noise_mm` per axis, and 0.5 % of the samples 100 mm off.
inline Take damaged_markers(const Take& truth, double noise_mm, std::uint64_t seed) {
  return test::damaged(truth, noise_mm, 0.005, 100, seed);
}

/// Every method except `auto` and the learned ones, at its defaults.
inline std::vector<std::string> other_methods() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    if (method.name != "auto" && !method.learned) names.push_back(method.name);
  }
  return names;
}

}  // namespace kinemend::quality
