// Writes a changed take into the text of its source BVH file.
#include <vector>

#include "io/bvh/bvh_text.hpp"
#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_rewrite.hpp"
#include "io/motion/motion_rows.hpp"

namespace kinemend {

namespace {

class BvhRowReader : public RowReader {
 public:
  explicit BvhRowReader(const BvhDocument& document)
      : width_(MotionColumns(document.skeleton).count()),
        rows_(document.bytes.data() + document.data_begin,
              document.bytes.data() + document.data_end, document.commas) {}

  void next(double* values, std::size_t frames, TokenSpan* tokens) override {
    rows_.next(values, frames * width_, tokens);
  }

 private:
  std::size_t width_;
  MotionRows rows_;
};

}  // namespace

std::unique_ptr<RowReader> BvhDocument::rows() const {
  return std::make_unique<BvhRowReader>(*this);
}

std::string rewrite_bvh(const Take& clip, const BvhDocument& document) {
  std::vector<DocumentEdit> edits;
  if (clip.frame_rate_hz != document.frame_rate_hz || document.frame_time_is_none) {
    edits.push_back({document.frame_time, frame_time_text(clip.frame_rate_hz)});
  }
  return rewrite_motion(clip, document, edits);
}

}  // namespace kinemend
