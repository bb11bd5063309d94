// Ranges of frames or seconds, as the flag `--range` gives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace kinemend::cli {

/// A value of `--range`: "121:240" are frames as the file numbers them, "1.5s:2s" are seconds from
/// the start; either end may be omitted.
struct FrameRange {
  bool in_seconds = false;
  std::optional<double> first;
  std::optional<double> last;
};

/// Errors: `ErrorKind::usage`.
FrameRange parse_range(const std::string& text);

/// Frames [first, last] of a take, counted from 0; `first_frame` is the number of its first.
/// Errors: `ErrorKind::usage` when the range leaves the take or holds no frame.
std::pair<std::size_t, std::size_t> frames_of(const FrameRange& range, std::size_t frame_count,
                                              double frame_rate_hz, std::int64_t first_frame);

}  // namespace kinemend::cli
