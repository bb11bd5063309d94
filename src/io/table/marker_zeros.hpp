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

/// Many programs write 0 0 0 where a marker was not seen. Finds the samples at exactly the origin
/// that no marker can have been at: it would have to jump there, or back, from farther away than 20
/// times the step that it usually makes from frame to frame (5 cm where that is not known), than 20
/// `resolution` (file units), and than 2 mm; or it is there in every frame of several, and so is
/// another marker (no two can be in one place) or such zeros stand elsewhere, in a clip where no
/// sample is missing otherwise. Millimetres are taken where the clip names no unit that is known. A
/// marker that rests at the origin or passes through it keeps its samples; so do points that are no
/// positions, and a sample of which `is_measured` (one for each sample, or empty) says so.
std::vector<ZeroGap> find_zero_gaps(const Take& clip, double resolution = 0,
                                    const std::vector<std::uint8_t>& is_measured = {});

/// How many samples the gaps hold.
std::size_t sample_count(const std::vector<ZeroGap>& gaps);

/// Makes the samples of gaps missing.
void mark_missing(const std::vector<ZeroGap>& gaps, Take& clip);

/// The result of `mark_zeros_missing`.
struct MissingZeros {
  std::size_t samples = 0;
  std::size_t first_frame = 0;  ///< of the first of them
};

/// Finds gaps of zeros and makes their samples missing.
MissingZeros mark_zeros_missing(Take& clip);

}  // namespace kinemend
