// Decodes the document's frames in blocks, and hides the zeros that mean gaps.
#include "io/c3d/c3d_source_frames.hpp"

#include <algorithm>

namespace kinemend {

C3dSourceFrames::C3dSourceFrames(const C3dDocument& document)
    : document_(document), decoder_(document.processor, document.layout) {
  const C3dLayout& layout = document.layout;
  points_.resize(c3d_block_frames(layout) * layout.point_count);
  if (document.zero_gaps.empty()) return;
  hidden_.resize(layout.frame_count * layout.point_count);
  for (const ZeroGap& gap : document.zero_gaps) {
    for (std::size_t f = gap.first; f < gap.last; ++f)
      hidden_[f * layout.point_count + gap.marker] = 1;
  }
}

bool C3dSourceFrames::next() {
  const C3dLayout& layout = document_.layout;
  first_ += count_;
  count_ = std::min(c3d_block_frames(layout), layout.frame_count - first_);
  if (count_ == 0 || layout.point_count == 0) return false;
  decoder_.decode(document_.bytes.data() + frame_begin(0), count_, points_);
  if (!hidden_.empty()) hide_zero_gaps();
  return true;
}

std::size_t C3dSourceFrames::frame_begin(std::size_t block_frame) const {
  return document_.layout.data_begin + (first_ + block_frame) * document_.layout.frame_bytes();
}

void C3dSourceFrames::hide_zero_gaps() {
  const std::size_t points = document_.layout.point_count;
  const std::uint8_t* const hidden = hidden_.data() + first_ * points;
  for (std::size_t i = 0; i < count_ * points; ++i) {
    if (hidden[i] == 0) continue;
    points_.observed[i] = 0;
    points_.residuals[i] = -1;
  }
}

std::int32_t C3dSourceFrames::word(std::size_t block_frame, std::size_t point) const {
  const C3dLayout& layout = document_.layout;
  if (points_.observed[block_frame * layout.point_count + point] == 0) return missing_point_word;
  const char* const place =
      document_.bytes.data() + frame_begin(block_frame) + (4 * point + 3) * layout.value_bytes();
  return with_words(document_.processor, [&](auto words) {
    return layout.is_float ? static_cast<std::int32_t>(words.real(place))
                           : static_cast<std::int32_t>(words.word(place));
  });
}

}  // namespace kinemend
