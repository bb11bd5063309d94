// The pieces of text that the writers of BVH share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/bvh/bvh_document.hpp"
#include "io/text/text_buffer.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Fewest decimals for which reading gives back the rate, at least six.
std::string frame_time_text(double frame_rate_hz);

/// How `append_motion` writes.
struct MotionStyle {
  std::string_view line_end = "\n";
  unsigned decimals = 6;
  std::string_view frame_time;
};

/// `MOTION` and all frames, one a line, joints in the given order; angles continue the frame
/// before. Errors: `usage` for values that are not finite.
void append_motion(TextBuffer& out, const Take& clip, const std::vector<std::size_t>& joints,
                   const MotionStyle& style);

/// The document's own text with every changed sample replaced; the clip has the document's skeleton
/// and frame count, and its rate too where the file has no frame time.
std::string rewrite_bvh(const Take& clip, const BvhDocument& document);

}  // namespace kinemend
