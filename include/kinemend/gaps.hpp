// Finds and marks spans of missing samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// A run of consecutive missing samples of one joint or marker.
struct Gap {
  /// Joint or marker; for positions of joints 0 is joint 0 and k + 1 is translated joint k.
  std::size_t track = 0;
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive

  std::size_t length() const noexcept { return last_frame - first_frame + 1; }
  friend bool operator==(const Gap&, const Gap&) = default;
};

/// Returns the runs of samples that are not observed, sorted by track, then frame. Points of a
/// marker clip that are not positions have no gaps.
std::vector<Gap> find_gaps(const Take& take);
/// Returns the gaps of `Take::observed_positions`.
std::vector<Gap> find_position_gaps(const Take& clip);

/// A gap as a side file states it, for formats that cannot store gaps.
struct NamedGap {
  std::string name;  ///< a joint or marker, or a shell pattern (`*` matches all)
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive, counted from 0
};

/// Marks the samples as not observed, so that nothing uses their values. A gap of a joint is a gap
/// of its rotation and, where it has position channels, of its position too. Errors:
/// `ErrorKind::usage` for a name or a frame that the take does not have.
void mark_gaps(Take& take, std::span<const NamedGap> gaps);

/// Reads a side file: lines `name,first,last`, in the frame numbers of the take, last frame
/// inclusive. `first_frame` is the number of the take's first frame (`first_frame_number(clip)`). A
/// heading line, `#` comments, blank lines and quoted names are allowed. `name` appears in
/// messages. Errors: `unreadable_input` with the line, also for a number below `first_frame`.
std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame);
/// Returns the text of such a side file.
std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame);

}  // namespace kinemend
