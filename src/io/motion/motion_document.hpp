// Keeps a text file of frames as it was read so that a changed take can be written into it, and
// repairs numbers that have no blank between them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A piece of a document's bytes; size 0 if the file does not have it.
struct ByteSpan {
  std::size_t begin = 0;
  std::size_t size = 0;
};

/// Reads the channel values of a text again, in the order of `MotionColumns`.
class RowReader {
 public:
  RowReader() = default;
  RowReader(const RowReader&) = delete;
  RowReader& operator=(const RowReader&) = delete;
  virtual ~RowReader() = default;
  /// Reads `frames` rows, angles in degrees; `tokens` receives the place of each value.
  virtual void next(double* values, std::size_t frames, TokenSpan* tokens) = 0;
};

/// A file of frames in text as it was read. The bytes hold every digit, so only a few offsets are
/// stored with them: a rewrite reads the numbers again, which is faster than storing the place of
/// each number.
struct MotionDocument : SourceDocument {
  std::string bytes;
  Skeleton skeleton;
  double frame_rate_hz = 0;
  std::size_t frame_count = 0;
  std::size_t data_begin = 0;  ///< beginning of the frames
  std::size_t data_end = 0;    ///< after the last channel value
  CommaStyle commas = CommaStyle::none;
  unsigned decimals = 0;  ///< most decimals of any channel value written without exponent
  double degrees_per_value = 1;
  std::vector<PositionFrame> position_frames;  ///< for joint 0, then for each translated joint
  /// Some channel values are not finite; only then the two members below are filled.
  bool has_gaps = false;
  std::vector<Quat> first_rotations;    ///< J: rotations of frame 0 after repair
  std::vector<double> first_positions;  ///< values of frame 0 after repair, one per position column

  std::string_view text(ByteSpan span) const {
    return std::string_view(bytes).substr(span.begin, span.size);
  }
  /// Returns the number of decimals for a changed value.
  unsigned written_decimals() const;
  /// Returns a reader at the first frame.
  virtual std::unique_ptr<RowReader> rows() const = 0;
  std::vector<double> channel_values() const override;
};

/// A piece of a document before its frames, and the text that replaces it.
struct DocumentEdit {
  ByteSpan place;
  std::string text;
};

/// Returns the document's text with every changed sample replaced and the edits applied, which must
/// be in the order of the text. The clip must have the document's skeleton and frame count. Angles
/// continue the frame before.
std::string rewrite_motion(const Take& clip, const MotionDocument& document,
                           const std::vector<DocumentEdit>& edits = {});

/// Notes the repair `numbers_joined`, made at these places.
void note_joined_numbers(const SourceText& text, const std::vector<const char*>& places);
/// Inserts a blank at each of the places in the document's bytes, in ascending order, so that every
/// program can read the output. Places behind the frames are ignored.
void separate_numbers(MotionDocument& document, const std::vector<const char*>& places);

}  // namespace kinemend
