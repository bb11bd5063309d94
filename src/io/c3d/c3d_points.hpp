// The samples of points in a C3D file: positions, residuals and cameras.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_layout.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// The fourth word of a point: below zero, or 65,535 where a writer has no signs, the point is
/// missing. Else its low byte times the scale is the residual, and each bit above stands for a
/// camera that saw the point.
constexpr std::int32_t missing_point_word = -1;

/// The samples of some frames, frame by frame.
struct C3dPoints {
  std::vector<Vec3> positions;  ///< zero where missing
  std::vector<std::uint8_t> observed;
  std::vector<float> residuals;  ///< file units; -1 where missing

  void resize(std::size_t count);
};

/// Counts of what the decoder found.
struct C3dPointCounts {
  std::size_t not_finite = 0;          ///< samples that are not finite and not marked as missing
  std::size_t missing_not_finite = 0;  ///< the same that are marked as missing
  std::size_t zeros = 0;               ///< samples at the origin that are not marked as missing
  std::uint32_t cameras = 0;           ///< bits of all cameras that saw a point
};

/// Decodes the points of a file's data section; frames lie in it `layout.frame_bytes()` apart.
class C3dPointDecoder {
 public:
  C3dPointDecoder(C3dProcessor processor, const C3dLayout& layout)
      : processor_(processor), layout_(layout) {}

  /// Decodes `count` frames that start at `frames` into `out`, which has room for them.
  void decode(const char* frames, std::size_t count, C3dPoints& out);
  const C3dPointCounts& counts() const { return counts_; }

 private:
  C3dProcessor processor_;
  C3dLayout layout_;
  C3dPointCounts counts_;
};

/// The fourth word of a sample that is there, for a residual in file units; `before` is the word it
/// had, `missing_point_word` where it was missing. A residual that the word tells already leaves it
/// as it is; one of 0, which says filled or filtered, takes the cameras away.
std::int32_t c3d_point_word(float residual, double scale, std::int32_t before);

/// How many frames of this layout make a block that stays in the processor's cache.
std::size_t c3d_block_frames(const C3dLayout& layout);

}  // namespace kinemend
