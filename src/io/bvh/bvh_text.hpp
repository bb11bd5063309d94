// The pieces of text that the writers of BVH share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/bvh/bvh_document.hpp"
#include "io/text/text_buffer.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Returns the frame time with the fewest decimals, at least six, that read back as the same rate.
std::string frame_time_text(double frame_rate_hz);

/// The style of `append_motion`.
struct MotionStyle {
  std::string_view line_end = "\n";
  unsigned decimals = 6;
  std::string_view frame_time;
};

/// Appends `MOTION` and all frames, one per line, with joints in the given order; angles continue
/// the frame before. Errors: `usage` for values that are not finite.
void append_motion(TextBuffer& out, const Take& clip, const std::vector<std::size_t>& joints,
                   const MotionStyle& style);

/// Returns the document's text with every changed sample replaced. The clip must have the
/// document's skeleton and frame count, and its rate too if the file has no frame time.
std::string rewrite_bvh(const Take& clip, const BvhDocument& document);

}  // namespace kinemend
