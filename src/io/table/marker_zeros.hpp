// Finds markers that are at the origin because they are missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Frames [first, last) in which a marker is at the origin because it is missing.
struct ZeroGap {
  std::size_t marker = 0;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Finds samples at exactly the origin that are missing, because many programs write 0 0 0 for a
/// marker that was not seen. A sample is missing if the marker would have to jump to the origin, or
/// back, by more than 20 times its usual step from frame to frame (5 cm if that is not known), more
/// than 20 `resolution` (file units), and more than 2 mm. In a clip of several frames, a marker
/// that is always at the origin is missing if another marker is there too (two cannot be in one
/// place) or such zeros occur elsewhere, and the clip marks no samples as missing. The unit is a
/// millimetre if the clip names no known unit. A marker that rests at the origin or passes through
/// it keeps its samples; so do points that are not positions, and samples that `is_measured` (one
/// mark per sample, or empty) marks.
std::vector<ZeroGap> find_zero_gaps(const Take& clip, double resolution = 0,
                                    const std::vector<std::uint8_t>& is_measured = {});

/// Returns the number of samples in the gaps.
std::size_t sample_count(const std::vector<ZeroGap>& gaps);

/// Makes the samples of gaps missing.
void mark_missing(const std::vector<ZeroGap>& gaps, Take& clip);

/// The result of `mark_zeros_missing`.
struct MissingZeros {
  std::size_t samples = 0;
  std::size_t first_frame = 0;  ///< frame of the first of these samples
};

/// Finds gaps of zeros and makes their samples missing.
MissingZeros mark_zeros_missing(Take& clip);

}  // namespace kinemend
