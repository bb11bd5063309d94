// The samples of points in a C3D file: positions, residuals and cameras.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_layout.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// The fourth word of a point. If it is below zero, or 65,535 from writers without signs, the point
/// is missing. Else its low byte times the scale is the residual, and each higher bit is a camera
/// that saw the point.
constexpr std::int32_t missing_point_word = -1;

/// The samples of some frames, frame by frame.
struct C3dPoints {
  std::vector<Vec3> positions;  ///< zero if missing
  std::vector<std::uint8_t> observed;
  std::vector<float> residuals;  ///< file units; -1 if missing

  void resize(std::size_t count);
};

/// Counts of the decoder.
struct C3dPointCounts {
  std::size_t not_finite = 0;          ///< samples that are not finite and not marked as missing
  std::size_t missing_not_finite = 0;  ///< samples that are not finite and marked as missing
  std::size_t zeros = 0;               ///< samples at the origin that are not marked as missing
  std::uint32_t cameras = 0;           ///< bits of all cameras that saw a point
};

/// Decodes the points of a file's data section, in which frames are `layout.frame_bytes()` apart.
class C3dPointDecoder {
 public:
  C3dPointDecoder(C3dProcessor processor, const C3dLayout& layout)
      : processor_(processor), layout_(layout) {}

  /// Decodes `count` frames that start at `frames` into `out`, which must be large enough.
  void decode(const char* frames, std::size_t count, C3dPoints& out);
  const C3dPointCounts& counts() const { return counts_; }

 private:
  C3dProcessor processor_;
  C3dLayout layout_;
  C3dPointCounts counts_;
};

/// Returns the fourth word of an observed sample for a residual in file units. `before` is the old
/// word, `missing_point_word` if the sample was missing. The old word is kept if it already has
/// this residual. A residual of 0, which means filled or filtered, removes the cameras.
std::int32_t c3d_point_word(float residual, double scale, std::int32_t before);

/// Returns how many frames of this layout form a block that stays in the processor's cache.
std::size_t c3d_block_frames(const C3dLayout& layout);

}  // namespace kinemend
