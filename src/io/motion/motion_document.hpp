// Keeps a text file of frames as it was read so that it can be written back in its own layout.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_rows.hpp"
#include "io/motion/position_frame.hpp"
#include "io/text/number.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A piece of a document's bytes; size 0 where the file has no such thing.
struct ByteSpan {
  std::size_t begin = 0;
  std::size_t size = 0;
};

/// Walks over the channel values of a text once more, in the order of `MotionColumns`.
class RowReader {
 public:
  RowReader() = default;
  RowReader(const RowReader&) = delete;
  RowReader& operator=(const RowReader&) = delete;
  virtual ~RowReader() = default;
  /// Reads `frames` rows, angles in degrees; `tokens` takes the place of each value.
  virtual void next(double* values, std::size_t frames, TokenSpan* tokens) = 0;
};

/// A file of frames in text as it was read. The bytes hold every digit, so beside them only
/// landmarks are kept: a rewrite walks over the numbers again, which is quicker than to store where
/// each one stands.
struct MotionDocument : SourceDocument {
  std::string bytes;
  Skeleton skeleton;
  double frame_rate_hz = 0;
  std::size_t frame_count = 0;
  std::size_t data_begin = 0;  ///< of the frames
  std::size_t data_end = 0;    ///< after the last channel value
  CommaStyle commas = CommaStyle::none;
  unsigned decimals = 0;  ///< most decimals of any channel value written without exponent
  double degrees_per_value = 1;
  std::vector<PositionFrame> position_frames;  ///< of joint 0, then of each translated joint
  bool has_gaps = false;  ///< some channel values are not finite; then the two below are filled
  std::vector<Quat> first_rotations;    ///< J: of frame 0 as repaired
  std::vector<double> first_positions;  ///< of frame 0 as repaired, one a position column

  std::string_view text(ByteSpan span) const {
    return std::string_view(bytes).substr(span.begin, span.size);
  }
  /// With how many a changed value is written.
  unsigned written_decimals() const;
  /// From the first frame.
  virtual std::unique_ptr<RowReader> rows() const = 0;
  std::vector<double> channel_values() const override;
};

}  // namespace kinemend
