// The format BVH: recognises, reads and writes it, and keeps a file as it was read so that it can
// be written back in its own layout.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/motion/motion_document.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Returns how likely the head of a file is BVH, 0 to 100.
int sniff_bvh(std::string_view head);
/// Reads BVH in all its dialects. Errors: `unreadable_input` with the line.
TakeResult read_bvh(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from BVH keeps its source's layout and the digits of every unchanged
/// sample; any other clip gets a plain layout. Errors: `usage` if the format cannot hold the clip.
std::string write_bvh(const Take& clip);

/// A BVH file as it was read.
struct BvhDocument : MotionDocument {
  std::size_t hierarchy_end = 0;    ///< after the last closing brace
  ByteSpan frame_time;              ///< the number after `Frame Time:`
  bool frame_time_is_none = false;  ///< the frame time is not a finite number
  /// Faults of the head that are mended in a file that is changed anyway. A time that is no finite
  /// number is unusable too.
  bool frame_time_is_unusable = false;
  ByteSpan wrong_frame_count;  ///< the number after `Frames:`, if wrong

  std::unique_ptr<RowReader> rows() const override;
};

/// Returns the frame time with the fewest decimals, at least six, that read back as the same rate.
std::string frame_time_text(double frame_rate_hz);

}  // namespace kinemend
