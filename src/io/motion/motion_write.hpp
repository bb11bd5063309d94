// Writes the frames of a take of joints as rows of text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/position_frame.hpp"
#include "io/text/text_buffer.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

bool same_skeleton(const Skeleton& a, const Skeleton& b);

/// Errors: `usage` when the skeleton breaks a rule, arrays do not have the clip's number of frames,
/// or the rate is not positive.
void check_lengths(const Take& clip);

/// How a format treats the rest rotation of a joint.
enum class RestRotations : std::uint8_t {
  in_channels,  ///< the rest rotation is part of the angles
  apart,        ///< it stands in the skeleton
};
/// A motion that no channel can hold is not dropped in silence. Errors: `usage`, naming the joint.
void check_channels(const Take& clip, RestRotations rest);

/// A value of a frame and the text before it.
struct WrittenValue {
  static constexpr std::size_t no_channel = static_cast<std::size_t>(-1);

  std::string lead;
  std::size_t joint = 0;
  std::size_t channel = no_channel;  ///< index in the joint's channels; none is written as 0
};

/// How `append_rows` writes.
struct RowStyle {
  std::string_view line_end = "\n";
  unsigned decimals = 6;
  RestRotations rest = RestRotations::in_channels;
  double degrees_per_value = 1;
  bool numbered = false;  ///< the number of a frame, from 1, on a line before it
};

/// All frames of a clip; angles continue the frame before. `position_frames`: see `MotionDocument`.
/// Errors: `usage` for values that are not finite.
void append_rows(TextBuffer& out, const Take& clip, const std::vector<WrittenValue>& values,
                 const std::vector<PositionFrame>& position_frames, const RowStyle& style);

}  // namespace kinemend
