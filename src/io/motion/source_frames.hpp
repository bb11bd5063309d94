// Reads the frames of a document again, for a rewrite.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_document.hpp"

namespace kinemend {

/// A block of frames of a document's text. Position columns are repaired; angles are as in the
/// file, in degrees.
struct SourceBlock {
  std::size_t first = 0;  ///< frame
  std::size_t count = 0;  ///< frames
  std::size_t width = 0;  ///< values of a frame
  std::size_t joints = 0;
  std::vector<double> values;
  std::vector<TokenSpan> places;
  std::vector<Quat> turns;

  const double* row(std::size_t frame) const { return values.data() + frame * width; }
  const TokenSpan* tokens(std::size_t frame) const { return places.data() + frame * width; }
  const Quat* rotations(std::size_t frame) const { return turns.data() + frame * joints; }
};

/// Decodes the frames of a document's text as its reader did, a block at a time.
class SourceFrames {
 public:
  explicit SourceFrames(const MotionDocument& document);

  const MotionColumns& columns() const { return columns_; }

  /// Reads the next block, reusing its memory; false after the last.
  bool next(SourceBlock& block);

 private:
  void hold(SourceBlock& block);

  const MotionDocument& document_;
  MotionColumns columns_;
  std::size_t next_ = 0;  // frame
  std::vector<Quat> last_rotations_;
  std::vector<double> last_positions_;
  std::unique_ptr<RowReader> text_;
};

}  // namespace kinemend
