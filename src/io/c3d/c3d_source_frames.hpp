// Reads the frames of a C3D document again, for a rewrite.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "io/c3d/c3d_points.hpp"

namespace kinemend {

/// The frames of a document, decoded and repaired as its reader did, a block at a time.
class C3dSourceFrames {
 public:
  explicit C3dSourceFrames(const C3dDocument& document);

  /// Moves to the next block; false after the last.
  bool next();

  std::size_t first() const { return first_; }  ///< frame of the take
  std::size_t count() const { return count_; }
  const C3dPoints& points() const { return points_; }
  /// Returns the offset of a frame of the block in the document's bytes.
  std::size_t frame_begin(std::size_t block_frame) const;
  /// Returns the fourth word of a sample; `missing_point_word` if it is missing.
  std::int32_t word(std::size_t block_frame, std::size_t point) const;

 private:
  void hide_zero_gaps();

  const C3dDocument& document_;
  C3dPointDecoder decoder_;
  C3dPoints points_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::vector<std::uint8_t> hidden_;  // F x M, 1 in a zero gap; empty without zero gaps
};

}  // namespace kinemend
