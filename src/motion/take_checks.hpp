// Checks that `validate` of skeletons and of takes share.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "kinemend/error.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

inline bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Throws `ErrorKind::usage` with `what` and both lengths if they differ.
inline void check_length(std::size_t actual, std::size_t expected, const char* what) {
  if (actual == expected) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} values, expected {}", what, actual, expected));
}

}  // namespace kinemend
