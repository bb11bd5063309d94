// Writes a changed take of joints into the text of the file that it comes from.
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

/// The document's own text with every changed sample replaced, and the edits, which are in the
/// order of the text. The clip has the document's skeleton and frame count. Angles continue the
/// frame before.
std::string rewrite_motion(const Take& clip, const MotionDocument& document,
                           const std::vector<DocumentEdit>& edits = {});

}  // namespace kinemend
