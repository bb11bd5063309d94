#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/marker_clip.hpp"

// Frames as people count them: frame f of a clip has the number f + `first_frame_number`.
namespace kinemend {

/// The number that the file gives to the first frame: of a C3D file its header's, of a table and
/// an AMC file that of its first row or frame; 1 for files that number none.
std::int64_t first_frame_number(const Clip& clip);
std::int64_t first_frame_number(const MarkerClip& clip);
/// The number of a frame of a take whose first has the number `first`.
std::int64_t frame_number(std::size_t frame, std::int64_t first);

/// `parse_gaps` of frames that are counted from `first_frame`. Errors: also `unreadable_input` for
/// a number below that.
std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame);
std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame);

}  // namespace kinemend
