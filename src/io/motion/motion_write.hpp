// Writes the frames of a take of joints as rows of text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

bool same_skeleton(const Skeleton& a, const Skeleton& b);
/// Whether two takes have the same joints, or the same markers, in the same unit, so that one can
/// be written in place of the samples of the other.
bool same_parts(const Take& a, const Take& b);

/// Throws `usage` if the skeleton breaks a rule, arrays do not have the clip's number of frames, or
/// the rate is not positive.
void check_lengths(const Take& clip);

/// How a format treats the rest rotation of a joint.
enum class RestRotations : std::uint8_t {
  in_channels,  ///< the rest rotation is part of the angles
  apart,        ///< the rest rotation is stored in the skeleton
};
/// Rejects motion that no channel can express, so that it is not lost silently. Errors: `usage`,
/// naming the joint.
void check_channels(const Take& clip, RestRotations rest);

/// A value of a frame and the text before it.
struct WrittenValue {
  static constexpr std::size_t no_channel = static_cast<std::size_t>(-1);

  std::string lead;
  std::size_t joint = 0;
  /// Index in the joint's channels; `no_channel` is written as 0.
  std::size_t channel = no_channel;
};

/// The style of `append_rows`.
struct RowStyle {
  std::string_view line_end = "\n";
  unsigned decimals = 6;
  RestRotations rest = RestRotations::in_channels;
  double degrees_per_value = 1;
  bool numbered = false;  ///< write the number of a frame, from 1, on a line before it
};

/// Appends all frames of a clip; angles continue the frame before. `position_frames`: see
/// `MotionDocument`. Errors: `usage` for values that are not finite.
void append_rows(TextBuffer& out, const Take& clip, const std::vector<WrittenValue>& values,
                 const std::vector<PositionFrame>& position_frames, const RowStyle& style);

}  // namespace kinemend
