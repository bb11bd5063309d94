// Argument checks that the filters share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/experimental/pose_matrix.hpp"

namespace kinemend::signal {

inline void require(bool condition, const std::string& message) {
  if (!condition) throw Error(ErrorKind::usage, message);
}

inline void require_marks(const PoseMatrix& matrix, std::span<const std::uint8_t> marks) {
  require(marks.empty() || marks.size() == matrix.frames * matrix.channels,
          "the marks of missing samples are not as many as the samples");
}

}  // namespace kinemend::signal
