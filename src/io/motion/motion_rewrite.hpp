// Writes a changed take of joints into the text of its source file.
#pragma once

#include <string>
#include <vector>

#include "io/motion/motion_document.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A piece of a document before its frames, and the text that replaces it.
struct DocumentEdit {
  ByteSpan place;
  std::string text;
};

/// Returns the document's text with every changed sample replaced and the edits applied, which must
/// be in the order of the text. The clip must have the document's skeleton and frame count. Angles
/// continue the frame before.
std::string rewrite_motion(const Take& clip, const MotionDocument& document,
                           const std::vector<DocumentEdit>& edits = {});

}  // namespace kinemend
