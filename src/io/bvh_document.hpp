#pragma once

#include <cstddef>
#include <memory>

#include "io/motion_document.hpp"

namespace kinemend {

/// A BVH file as it was read.
struct BvhDocument : MotionDocument {
  std::size_t hierarchy_end = 0;  ///< after the last closing brace
  ByteSpan frame_time;            ///< the number behind `Frame Time:`

  std::unique_ptr<RowReader> rows() const override;
};

}  // namespace kinemend
