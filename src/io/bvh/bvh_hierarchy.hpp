// The part of a BVH file above its frames: the hierarchy, the number of frames and their rate.
#pragma once

#include <cstddef>
#include <optional>

#include "io/bvh/bvh.hpp"
#include "io/text/number.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// The part of a file before the channel values.
struct BvhHeader {
  Skeleton skeleton;
  std::size_t hierarchy_end = 0;
  bool has_motion = false;
  std::optional<std::size_t> frames;  ///< as declared; empty if missing or not a whole number
  ByteSpan frame_count;
  double frame_time_s = 0;  ///< 0 if missing or unusable
  ByteSpan frame_time;
  bool frame_time_is_none = false;  ///< the frame time is not a finite number
  std::size_t data_begin = 0;
};

/// A file with more joints or end sites than this is rejected. Chosen by hand.
inline constexpr std::size_t most_joints = 16384;

/// Parses up to the first channel value. `unknown_rate_hz`: the rate if the file has no usable
/// frame time. Errors: `unreadable_input` with the line.
BvhHeader read_bvh_header(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth,
                          double unknown_rate_hz);

/// Returns the frames per second of a frame time as written: a usual rate (24, 25, 30, ..., 240 and
/// their NTSC neighbours) if the text is within 1e-3 of it (1e-6 with nine digits or more), a whole
/// number of hertz within 1e-4 if the text is its frame time rounded, else the reciprocal.
double rate_from_frame_time(double frame_time_s, std::string_view text);

}  // namespace kinemend
