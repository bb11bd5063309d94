#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/number.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// A piece of the document's bytes; size 0 where the file has no such thing.
struct ByteSpan {
  std::size_t begin = 0;
  std::size_t size = 0;
};

/// A BVH file as it was read. The bytes hold every digit, so beside them only landmarks are kept: a
/// rewrite walks over the numbers again, which is quicker than to store where each one stands.
struct BvhDocument : SourceDocument {
  std::string bytes;
  Skeleton skeleton;
  double frame_rate_hz = 0;
  std::size_t frame_count = 0;
  std::size_t hierarchy_end = 0;  ///< after the last closing brace
  ByteSpan frame_time;            ///< the number behind `Frame Time:`
  std::size_t data_begin = 0;     ///< of the channel values
  std::size_t data_end = 0;       ///< after the last of them
  CommaStyle commas = CommaStyle::none;
  unsigned decimals = 0;  ///< most decimals of any channel value written without exponent
  bool has_gaps = false;  ///< some channel values are not finite; then the two below are filled
  std::vector<Quat> first_rotations;    ///< J: of frame 0 as repaired
  std::vector<double> first_positions;  ///< of frame 0 as repaired, one a position column

  std::vector<double> channel_values() const override;
  std::string_view text(ByteSpan span) const {
    return std::string_view(bytes).substr(span.begin, span.size);
  }
};

}  // namespace kinemend
