// Keeps a BVH file as it was read so that it can be written back in its own layout.
#pragma once

#include <cstddef>
#include <memory>

#include "io/motion/motion_document.hpp"

namespace kinemend {

/// A BVH file as it was read.
struct BvhDocument : MotionDocument {
  std::size_t hierarchy_end = 0;    ///< after the last closing brace
  ByteSpan frame_time;              ///< the number after `Frame Time:`
  bool frame_time_is_none = false;  ///< the frame time is not a finite number

  std::unique_ptr<RowReader> rows() const override;
};

}  // namespace kinemend
